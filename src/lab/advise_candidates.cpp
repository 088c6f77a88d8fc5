// SPDX-License-Identifier: Apache-2.0
#include "lab/advise.h"

#include "base/error.h"
#include "base/names.h"

#include <algorithm>
#include <cmath>

namespace gnomon::lab {

namespace {

using shadow::ParamInfo;
using shadow::ParamType;

/// Penumbrae narrower than this many pixels look like hard edges that were smoothed.
constexpr double narrow = 3.0;

bool has_choice(const ParamInfo* info, const std::string& name)
{
    return info && info->type == ParamType::choice && std::find(info->choices.begin(), info->choices.end(), name) != info->choices.end();
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

/// What a technique spends its time on, by the names that such parameters have, and how much less and more of it is tried.
struct Amount {
    const char* name;
    double less, more;
};
constexpr Amount amounts[]
    = {{"map_size", 0.5, 2}, {"samples", 0.25, 4}, {"taps", 0.5, 2}, {"search_taps", 0.5, 2}, {"kernel", 0.34, 2}, {"pcf", 0.34, 2}};

bool is_amount(const ParamInfo& info)
{
    return info.type == ParamType::integer
        && std::any_of(std::begin(amounts), std::end(amounts), [&](const Amount& a) { return info.name == a.name; });
}

/// Several maps of map_size in place of one.
bool has_layers(const Choice& choice)
{
    const ParamInfo* fit = choice.params.table().find("fit");
    const std::string name = fit ? choice.params.text(*fit) : "";
    return name == "cascades" || name == "sdsm";
}

void add_amounts(const Choice& base, std::vector<Choice>& out)
{
    for (const Amount& amount : amounts) {
        const ParamInfo* info = base.params.table().find(amount.name);
        if (!info) continue;
        if (info->type == ParamType::choice)
            for (size_t i = 0; i < info->choices.size(); ++i) add(out, with(base, *info, double(i)));
        if (info->type != ParamType::integer) continue;
        const double now = base.params.get(*info);
        const bool odd = std::fmod(now, 2.0) == 1.0; // windows are: even ones have no middle
        for (const double factor : {amount.less, amount.more}) {
            const double value = std::round(now * factor);
            add(out, with(base, *info, odd && std::fmod(value, 2.0) == 0.0 ? value + 1.0 : value));
        }
    }
    const ParamInfo *taps = base.params.table().find("taps"), *search = base.params.table().find("search_taps");
    if (taps && search && is_amount(*taps) && is_amount(*search))
        add(out, with(with(base, *taps, 2 * base.params.get(*taps)), *search, 2 * base.params.get(*search)));
}

/// With what makes the technique let light through semitransparent casters: a parameter that turns its output into transmittance.
void add_transmittance(const Choice& base, std::vector<Choice>& out)
{
    if (!base.info->output_of || output_of(base) == shadow::Output::transmittance) return;
    for (const ParamInfo& p : base.params.table().fields) {
        const size_t values = p.type == ParamType::choice ? p.choices.size() : p.type == ParamType::flag ? 2 : 0;
        for (size_t i = 0; i < values; ++i)
            if (Choice other = with(base, p, double(i)); output_of(other) == shadow::Output::transmittance) add(out, std::move(other));
    }
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

std::vector<Choice> settings(const shadow::TechniqueInfo& info, const scene::Light& light, Prefer prefer, bool see_through)
{
    std::vector<Choice> out;
    const std::vector<Choice> bases = fitted(default_choice(info), light, prefer);
    for (const Choice& base : bases) add(out, base);
    if (!bases.empty()) add_amounts(bases.front(), out);
    if (!bases.empty() && see_through) add_transmittance(bases.front(), out);
    // several layers again with half as wide ones: four of them have the texels of one
    for (size_t i = 1; i < bases.size(); ++i)
        if (const ParamInfo* size = bases[i].params.table().find("map_size"); size && is_amount(*size))
            add(out, with(bases[i], *size, std::round(0.5 * bases[i].params.get(*size))));
    // the cheap ones first, so that the others need not be measured where these cost too much already
    const auto texels = [](const Choice& c) {
        const ParamInfo* size = c.params.table().find("map_size");
        return size ? c.params.get(*size) : 0.0;
    };
    std::stable_sort(out.begin(), out.end(), [&](const Choice& a, const Choice& b) { return texels(a) < texels(b); });
    return out;
}

bool costs_more(const Choice& a, const Choice& b)
{
    if (a.info != b.info) return false;
    bool more = false;
    for (const ParamInfo& p : a.params.table().fields) {
        const double from = b.params.get(p), to = a.params.get(p);
        if (from == to) continue;
        const bool layers = p.name == "fit" && has_layers(a) && !has_layers(b);
        if (!layers && (!is_amount(p) || to < from)) return false;
        more = true;
    }
    return more;
}

std::vector<Candidate> find_candidates(const gpu::Device& device, const Stage& stage, const Features& features, Prefer prefer)
{
    std::vector<Candidate> out;
    for (const shadow::TechniqueInfo* info : shadow::techniques()) {
        if (const std::string why = left_out(*info, device, stage, features, prefer); !why.empty()) {
            out.push_back({default_choice(*info), why});
            continue;
        }
        for (Choice& choice : settings(*info, stage.lights.front(), prefer, features.see_through > 0))
            out.push_back({std::move(choice), ""});
    }
    return out;
}

} // namespace gnomon::lab
