// SPDX-License-Identifier: Apache-2.0
#include "exact_suite.h"

extern const gnomon::shadow::TechniqueInfo technique_per_triangle_volumes;

namespace gnomon {
namespace {

const auto subjects = testing::Values(ExactSubject{technique_per_triangle_volumes, "plain", {}},
    ExactSubject{technique_per_triangle_volumes, "shared_memory", {{"team", 1}}});
INSTANTIATE_TEST_SUITE_P(per_triangle_volumes, ExactSoups, subjects, exact_name);
INSTANTIATE_TEST_SUITE_P(per_triangle_volumes, ExactPlaces, subjects, exact_name);
INSTANTIATE_TEST_SUITE_P(per_triangle_volumes, ExactBadInput, subjects, exact_name);

} // namespace
} // namespace gnomon
