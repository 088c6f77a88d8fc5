// SPDX-License-Identifier: Apache-2.0
#include "lab/render.h"

#include "base/error.h"
#include "lab/preset.h"

#include <fmt/format.h>

namespace gnomon::lab {

using namespace shadow;

Choice default_choice(const TechniqueInfo& info) { return {&info, ParamValues(info.params())}; }

Choice parse_choice(const std::string& text)
{
    const size_t colon = text.find(':');
    const std::string first = text.substr(0, colon);
    Choice choice = first.starts_with('@') ? read_preset_choice(first.substr(1)) : default_choice(technique(first));
    for (size_t at = colon; at != std::string::npos;) {
        const size_t next = text.find(':', at + 1);
        const std::string item = text.substr(at + 1, next == std::string::npos ? next : next - at - 1);
        const size_t equals = item.find('=');
        if (equals == std::string::npos) base::fail("'{}' after technique {} is not name=value", item, first);
        choice.params.set(item.substr(0, equals), std::string_view(item).substr(equals + 1));
        at = next;
    }
    return choice;
}

std::string choice_text(const Choice& choice)
{
    std::string out(choice.info->id);
    const ParamValues defaults(choice.info->params());
    for (const ParamInfo& p : choice.params.table().fields)
        if (choice.params.get(p) != defaults.get(p)) out += fmt::format(":{}={}", p.name, choice.params.text(p));
    return out;
}

Output output_of(const Choice& choice) { return shadow::output(*choice.info, choice.params.bytes()); }

} // namespace gnomon::lab
