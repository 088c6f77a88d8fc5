// SPDX-License-Identifier: Apache-2.0
#include "device.h"

#include "lab/bench.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gnomon::cli {

int bench(const Bench& options)
{
    const auto device = open_device(options.common);
    const std::vector<std::string> techniques = options.techniques.empty() ? std::vector<std::string>{"shadow_map"} : options.techniques;
    const lab::Bench result = lab::bench(*device, {stage_options(options.picture), techniques, options.reference, options.repeats});
    demand_valid(*device);
    if (options.common.json)
        fmt::print("{}\n", lab::bench_json(result).dump(1));
    else
        fmt::print("{}", lab::bench_table(result));
    return 0;
}

} // namespace gnomon::cli
