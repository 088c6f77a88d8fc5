// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"
#include "truth/cache.h"

#include <chrono>

namespace gnomon::truth {

Reference reference(const scene::Scene& s, const scene::View& view, const scene::Light& light, const Settings& settings, Quantity quantity,
    const std::filesystem::path& folder)
{
    const std::filesystem::path used = folder.empty() ? base::cache_folder() / "truth" : folder;
    const std::string key = cache_key(s, view, light, settings, quantity);
    if (std::optional<Reference> found = load(used, key, view.size, channels(quantity, light))) return std::move(*found);

    const Tracer tracer(s);
    Reference r;
    const auto begin = std::chrono::steady_clock::now();
    r.primary = tracer.primary(view, settings.threads);
    r.visibility = quantity == Quantity::visibility ? tracer.visibility(view, r.primary, light, settings)
                                                    : tracer.transmittance(view, r.primary, light, settings);
    r.trace_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    try {
        store(used, key, r);
        prune(used, cache_limit);
    } catch (const base::Error&) {
        // A folder that cannot be written costs the next run its time, but this one has its result.
    }
    return r;
}

} // namespace gnomon::truth
