// SPDX-License-Identifier: Apache-2.0
// Shadow volumes: the suite of exact techniques by each way of counting.
#include "exact_suite.h"

extern const gnomon::shadow::TechniqueInfo technique_shadow_volumes;

namespace gnomon {

namespace {

constexpr double zfail = 1, zp_plus = 2, pp_zp = 3;

const ExactSubject by_zfail{technique_shadow_volumes, "zfail", {{"count", zfail}}, 0, 200};
const ExactSubject by_pp_zp{technique_shadow_volumes, "pp_zp", {{"count", pp_zp}}, 0, 200};
const ExactSubject by_zp_plus{technique_shadow_volumes, "zp_plus", {{"count", zp_plus}}, 90, 30};

} // namespace

INSTANTIATE_TEST_SUITE_P(shadow_volumes, ExactSoups, testing::Values(by_zfail, by_pp_zp, by_zp_plus), exact_name);
INSTANTIATE_TEST_SUITE_P(shadow_volumes, ExactPlaces, testing::Values(by_zfail, by_pp_zp, by_zp_plus), exact_name);
INSTANTIATE_TEST_SUITE_P(shadow_volumes, ExactBadInput, testing::Values(by_zfail, by_pp_zp, by_zp_plus), exact_name);

} // namespace gnomon
