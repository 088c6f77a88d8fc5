// SPDX-License-Identifier: Apache-2.0
#include "lab/advise.h"

#include "base/error.h"
#include "base/names.h"

#include <algorithm>
#include <cmath>

namespace gnomon::lab {

namespace {

using shadow::ParamInfo;

/// Penumbrae narrower than this many pixels look like hard edges that were smoothed.
constexpr double narrow = 3.0;

bool has(const shadow::TechniqueInfo& info, const char* name) { return info.params().find(name) != nullptr; }

bool has_choice(const ParamInfo* info, const std::string& name)
{
    return info && info->type == shadow::ParamType::choice
        && std::find(info->choices.begin(), info->choices.end(), name) != info->choices.end();
}

void add(std::vector<Choice>& out, Choice choice)
{
    const auto same = [&](const Choice& c) { return std::ranges::equal(c.params.bytes(), choice.params.bytes()); };
    if (std::none_of(out.begin(), out.end(), same)) out.push_back(std::move(choice));
}

Choice with(Choice choice, const ParamInfo& info, double value)
{
    choice.params.set(info.name, std::clamp(value, info.range.min, info.range.max));
    return choice;
}

/// More and less of what a technique spends its time on, by the names that such parameters have.
void add_amounts(const Choice& base, std::vector<Choice>& out)
{
    struct Amount {
        const char* name;
        double less, more;
    };
    for (const Amount& amount : {Amount{"map_size", 0.5, 2}, {"samples", 0.25, 4}, {"taps", 0.5, 2}, {"search_taps", 0.5, 2},
             {"kernel", 0.34, 2}, {"pcf", 0.34, 2}}) {
        const ParamInfo* info = base.params.table().find(amount.name);
        if (!info) continue;
        if (info->type == shadow::ParamType::choice)
            for (size_t i = 0; i < info->choices.size(); ++i) add(out, with(base, *info, double(i)));
        if (info->type != shadow::ParamType::integer) continue;
        const double now = base.params.get(*info);
        // windows are odd: even ones have no middle
        const double odd = std::fmod(now, 2.0) == 1.0 ? 1.0 : 0.0;
        for (const double factor : {amount.less, amount.more}) {
            const double value = std::round(now * factor);
            add(out, with(base, *info, odd != 0.0 && std::fmod(value, 2.0) == 0.0 ? value + 1.0 : value));
        }
    }
    const ParamInfo *taps = base.params.table().find("taps"), *search = base.params.table().find("search_taps");
    if (taps && search && taps->type == shadow::ParamType::integer && search->type == shadow::ParamType::integer)
        add(out, with(with(base, *taps, 2 * base.params.get(*taps)), *search, 2 * base.params.get(*search)));
}

/// Maps that follow the view, where light and technique take them; those whose shadows' edges swim are not stable.
std::vector<Choice> fitted(const Choice& base, const scene::Light& light, Prefer prefer)
{
    const ParamInfo* fit = base.params.table().find("fit");
    const ParamInfo* stable = base.params.table().find("stable_cascades");
    std::vector<Choice> out;
    const auto take = [&](const char* name) {
        if (!has_choice(fit, name)) return;
        Choice choice = base;
        choice.params.set("fit", std::string_view(name));
        out.push_back(std::move(choice));
    };
    if (prefer == Prefer::stable) {
        take("uniform");
        if (stable && light.kind() == scene::LightKind::directional) {
            take("cascades");
            if (!out.empty() && has_choice(fit, "cascades")) out.back().params.set("stable_cascades", 1.0);
        }
        if (!fit) out.push_back(base);
        return out;
    }
    out.push_back(base);
    if (light.kind() == scene::LightKind::directional) take("cascades"), take("sdsm");
    return out;
}

std::string left_out(const shadow::TechniqueInfo& info, const gpu::Device& device, const Stage& stage, const Features& f, Prefer prefer)
{
    const scene::Light& light = stage.lights.front();
    if (const std::string reason = unmeasurable(default_choice(info), device, light); !reason.empty()) return reason;
    if (info.partial) return "it shadows only some surfaces, or by some casters";
    if (info.temporal && f.moves) return "it keeps what it drew, and the model moves: a still moment would flatter it";
    const bool wide = f.soft && f.penumbra_pixels >= narrow;
    if (prefer == Prefer::exact && !info.exact) return "it is not exact";
    if (prefer == Prefer::exact && wide && !info.soft) return "it is exact for hard lights only";
    if (prefer == Prefer::soft && !info.soft) return "it takes the light as a point";
    if (prefer == Prefer::stable && info.temporal) return "it keeps state between frames";
    return "";
}

} // namespace

Prefer parse_prefer(const std::string& text)
{
    static const std::vector<std::string> names = {"any", "exact", "soft", "stable"};
    const auto found = std::find(names.begin(), names.end(), text);
    if (found == names.end()) throw base::Error(base::unknown_name("preference", text, names));
    return Prefer(found - names.begin());
}

std::vector<Choice> settings(const shadow::TechniqueInfo& info, const scene::Light& light, Prefer prefer)
{
    std::vector<Choice> out;
    const std::vector<Choice> bases = fitted(default_choice(info), light, prefer);
    for (const Choice& base : bases) add(out, base);
    if (!bases.empty()) add_amounts(bases.front(), out);
    // the layers that follow the view again, with twice the texels: the two that most often help together
    if (has(info, "map_size"))
        for (size_t i = 1; i < bases.size(); ++i) {
            const ParamInfo& size = *bases[i].params.table().find("map_size");
            if (size.type == shadow::ParamType::integer) add(out, with(bases[i], size, 2 * bases[i].params.get(size)));
        }
    return out;
}

std::vector<Candidate> find_candidates(const gpu::Device& device, const Stage& stage, const Features& features, Prefer prefer)
{
    std::vector<Candidate> out;
    for (const shadow::TechniqueInfo* info : shadow::techniques()) {
        if (const std::string why = left_out(*info, device, stage, features, prefer); !why.empty()) {
            out.push_back({default_choice(*info), why});
            continue;
        }
        for (Choice& choice : settings(*info, stage.lights.front(), prefer)) out.push_back({std::move(choice), ""});
    }
    return out;
}

} // namespace gnomon::lab
