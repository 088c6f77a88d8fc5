// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/search.h"
#include "shadow/params.h"

#include <string>
#include <vector>

namespace gnomon::lab {

/// Some parameters of a technique as the axes of a search; the others stay as they are.
class SearchSpace {
public:
    /// Throws base::Error on a name that is no parameter.
    SearchSpace(shadow::ParamValues base, const std::vector<std::string>& vary);
    const std::vector<Axis>& axes() const { return axes_; }
    Point point(const shadow::ParamValues&) const;
    shadow::ParamValues params(const Point&) const;

private:
    shadow::ParamValues base_;
    std::vector<shadow::ParamInfo> fields_;
    std::vector<Axis> axes_;
};

/// Ranges above 0 whose ends are a hundredfold apart are logarithmic; of those that begin at 0, the ones whose default lies below a
/// twentieth of the end: what is of use there is small, and 0 stays a value of its own.
Axis axis_of(const shadow::ParamInfo&, double default_value);

} // namespace gnomon::lab
