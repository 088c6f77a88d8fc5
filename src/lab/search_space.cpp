// SPDX-License-Identifier: Apache-2.0
#include "lab/search_space.h"

#include "base/error.h"
#include "base/names.h"

namespace gnomon::lab {

Axis axis_of(const shadow::ParamInfo& info, double default_value)
{
    const auto [low, high] = info.range;
    if (info.type == shadow::ParamType::choice || info.type == shadow::ParamType::flag) return Axis::words(int(high) + 1);
    Axis::Scale scale = Axis::Scale::linear;
    if (low > 0 && high >= 100 * low) scale = Axis::Scale::logarithmic;
    if (low == 0 && default_value < 0.05 * high) scale = Axis::Scale::zero_and_logarithmic;
    return info.type == shadow::ParamType::integer ? Axis::integer(low, high, scale) : Axis::real(low, high, scale);
}

SearchSpace::SearchSpace(shadow::ParamValues base, const std::vector<std::string>& vary)
    : base_(std::move(base))
{
    std::vector<std::string> names;
    for (const shadow::ParamInfo& f : base_.table().fields) names.push_back(f.name);
    shadow::ParamValues defaults(base_.table());
    for (const std::string& name : vary) {
        const shadow::ParamInfo* info = base_.table().find(name);
        if (!info) throw base::Error(base::unknown_name("parameter", name, names));
        fields_.push_back(*info);
        axes_.push_back(axis_of(*info, defaults.get(*info)));
    }
}

Point SearchSpace::point(const shadow::ParamValues& params) const
{
    Point out;
    for (const shadow::ParamInfo& f : fields_) out.push_back(params.get(f));
    return out;
}

shadow::ParamValues SearchSpace::params(const Point& point) const
{
    shadow::ParamValues out = base_;
    for (size_t i = 0; i < fields_.size(); ++i) out.set(fields_[i].name, point[i]);
    return out;
}

} // namespace gnomon::lab
