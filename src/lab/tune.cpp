// SPDX-License-Identifier: Apache-2.0
#include "lab/tune.h"

#include "base/error.h"
#include "base/hash.h"
#include "base/line_file.h"
#include "base/progress.h"
#include "lab/goal.h"
#include "lab/meter.h"
#include "lab/search_space.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace gnomon::lab {

namespace {

using Json = nlohmann::ordered_json;

/// What is kept of one run.
struct Kept {
    std::map<std::string, double> values; ///< quantities of the goal
    std::map<std::string, double> reference; ///< the same of the search's start, measured just before; only what ratios need
};

class Tuner {
public:
    Tuner(gpu::Device& device, const TuneOptions& options)
        : device_(device)
        , options_(options)
        , base_(parse_choice(options.technique))
        , meter_(device, {.truth_samples = options.truth_samples, .reference = options.reference, .truth_cache = options.truth_cache})
        , sum_(parse_sum(options.minimise))
        , vary_(varied())
        , space_(base_.params, vary_)
    {
        for (const std::string& text : options.under) under_.push_back(parse_constraint(text));
        for (const std::string& q : sum_) note(q, is_cost(q));
        for (const Constraint& c : under_) note(c.quantity, c.relative);
        if (options.preset.extension() != ".json") base::fail("'{}' is no .json file; name the preset so", options.preset.string());
        if (options.budget < 1) base::fail("a budget of {} evaluations allows none; take at least 1", options.budget);
        if (options.tuning.empty())
            base::fail("no scene to tune on; name scene files that say \"tuning\": true, as experiments/tuning/*.json");
        for (const StageOptions& stage : options.tuning) add(stage, true);
        tuning_places_ = meter_.places();
        for (const StageOptions& stage : options.validation) add(stage, false);
        file_.emplace(std::filesystem::path(options.preset).replace_extension(".runs.jsonl"));
        for (const std::string& line : file_->lines()) take(line);
    }

    Tuned run()
    {
        const Point start = space_.point(base_.params);
        base::Progress progress(
            "tune " + std::string(base_.info->id), size_t(options_.budget) * tuning_places_ + meter_.places() - tuning_places_);
        progress_ = &progress;
        const SearchResult found = search({.axes = space_.axes(),
            .start = start,
            .places = tuning_places_,
            .budget = size_t(options_.budget),
            .seed = options_.seed,
            .measure = [this, &start](const Point& p, size_t place) { return read(p, place, p == start); },
            .improved =
                [this](const Point& p, const Reading& r) {
                    if (r.violation == 0) write_preset(options_.preset, preset(p, {}));
                }});
        if (found.reading.violation > 0) refuse(found);
        Tuned out{preset(found.best, validated(start, found.best)), better(found.reading, found.start), measured_, from_file_};
        write_preset(options_.preset, out.preset);
        return out;
    }

private:
    std::vector<std::string> varied() const
    {
        if (!options_.vary.empty()) return options_.vary;
        std::vector<std::string> out;
        const std::vector<std::string> held = set_names(options_.technique);
        for (const shadow::ParamInfo& f : base_.params.table().fields)
            if (std::find(held.begin(), held.end(), f.name) == held.end()) out.push_back(f.name);
        if (out.empty()) base::fail("{} has no parameter to tune: it has none, or all are set", options_.technique);
        return out;
    }

    void note(const std::string& quantity, bool relative)
    {
        if (std::find(quantities_.begin(), quantities_.end(), quantity) == quantities_.end()) quantities_.push_back(quantity);
        if (relative) relative_.push_back(quantity);
        if (quantity == "time") repeats_ = 3;
    }

    void add(StageOptions stage, bool tuning)
    {
        stage.kinds = base_.info->lights;
        const size_t place = meter_.add(stage);
        const Stage& opened = meter_.stage(place);
        if (tuning && !opened.scene.tuning)
            base::fail("{} may not be tuned on: it is a scene of published tables; a scene file with \"tuning\": true may "
                       "(docs/scene-files.md), or give it to --validate",
                stage.scene);
        if (!tuning && opened.scene.tuning)
            base::fail("{} is a scene for tuning and says nothing about others; validate on scenes without \"tuning\": true", stage.scene);
        if (const std::string reason = unmeasurable(base_, device_, opened.lights.front()); !reason.empty()) base::fail("{}", reason);
    }

    std::string key(const Choice& choice, size_t place)
    {
        if (keys_.size() <= place) keys_.resize(meter_.places());
        if (keys_[place].empty()) keys_[place] = meter_.key(place);
        base::Hasher h;
        h.text("tune 1").text(keys_[place]).text(choice.info->id).text(choice.params.json().dump()).text(base_.params.json().dump());
        h.text(options_.reference).text(device_.info().name).text(device_.info().driver).text(commit()).value(repeats_);
        for (const std::string& q : quantities_) h.text(q);
        return h.hex();
    }

    void take(const std::string& line)
    {
        const Json json = Json::parse(line, nullptr, false);
        if (!json.is_object() || !json.contains("key") || !json.contains("values") || !json.contains("reference"))
            base::fail("{} holds a line that is no measurement of this search: {}; delete the file or name another preset",
                std::filesystem::path(options_.preset).replace_extension(".runs.jsonl").string(), line.substr(0, 60));
        known_[json["key"].get<std::string>()] = {json["values"], json["reference"]};
        of_file_.insert(json["key"].get<std::string>());
    }

    /// Of the file, else measured now; nothing where the device could not run this setting.
    const Kept& kept(const Choice& choice, size_t place, bool start)
    {
        const std::string k = key(choice, place);
        const auto found = known_.find(k);
        if (found != known_.end()) {
            from_file_ += of_file_.erase(k);
            return found->second;
        }
        Kept now;
        try {
            Run reference;
            if (!relative_.empty()) reference = meter_.measure_time(place, base_, repeats_);
            const Run run = meter_.measure(place, choice, repeats_);
            for (const std::string& q : quantities_) now.values[q] = quantity_of(run, q);
            for (const std::string& q : relative_)
                now.reference[q] = is_cost(q) ? quantity_of(reference, q) : start ? now.values[q] : kept(base_, place, true).values.at(q);
        } catch (const base::Error&) {
            // a setting may ask for more memory than there is; that the search's start cannot run is the caller's fault
            if (start) throw;
            now = {};
        }
        ++measured_;
        file_->append(
            Json{{"key", k}, {"choice", choice_text(choice)}, {"place", place}, {"values", now.values}, {"reference", now.reference}}
                .dump());
        return known_[k] = std::move(now);
    }

    double sum(const Kept& kept) const
    {
        double out = 0;
        for (const std::string& q : sum_) out += is_cost(q) ? ratio(kept.values.at(q), kept.reference.at(q)) : kept.values.at(q);
        return out;
    }

    static double ratio(double value, double by) { return by > 0 ? value / by : value > 0 ? 1e6 : 1.0; }

    double missed(const Constraint& c, const Kept& kept) const
    {
        const double limit = c.relative ? c.limit * kept.reference.at(c.quantity) : c.limit;
        return missed_by(kept.values.at(c.quantity), limit);
    }

    Reading read(const Point& point, size_t place, bool start)
    {
        const Kept& k = kept({base_.info, space_.params(point)}, place, start);
        progress_->advance();
        if (k.values.empty()) return {0, 1e6};
        // As parts of what the start errs there, so that no scene outweighs the others; the addend is a few pixels' worth where that is
        // nothing.
        constexpr double few = 1e-4;
        Reading out{(sum(k) + few) / (sum(kept(base_, place, true)) + few), 0};
        for (const Constraint& c : under_) out.violation += missed(c, k);
        return out;
    }

    std::vector<Preset::Place> places(const Choice& after, size_t from, size_t to)
    {
        std::vector<Preset::Place> out;
        for (size_t i = from; i < to; ++i) {
            const Kept before = kept(base_, i, true), now = kept(after, i, false);
            if (now.values.empty()) base::fail("{} cannot run on every scene of the validation", choice_text(after));
            const Stage& stage = meter_.stage(i);
            Preset::Place place{stage.scene_name, stage.camera.name, meter_.light_name(i), stage.view.size, sum(before), sum(now)};
            if (now.reference.count("time")) place.time_ratio = ratio(now.values.at("time"), now.reference.at("time"));
            out.push_back(place);
        }
        return out;
    }

    std::vector<Preset::Place> validated(const Point& start, const Point& best)
    {
        for (size_t i = tuning_places_; i < meter_.places(); ++i) read(start, i, true), read(best, i, best == start);
        return places({base_.info, space_.params(best)}, tuning_places_, meter_.places());
    }

    Preset preset(const Point& point, std::vector<Preset::Place> validation)
    {
        Preset out{.choice = {base_.info, space_.params(point)}, .vary = vary_, .minimise = options_.minimise, .under = options_.under};
        out.reference = options_.reference;
        out.tuning = places(out.choice, 0, tuning_places_), out.validation = std::move(validation);
        out.evaluations = size_t(options_.budget), out.seed = options_.seed;
        out.device = device_.info().name, out.driver = device_.info().driver, out.commit = commit();
        return out;
    }

    [[noreturn]] void refuse(const SearchResult& found)
    {
        const Choice nearest{base_.info, space_.params(found.best)};
        std::string misses;
        for (const Constraint& c : under_)
            for (size_t i = 0; i < tuning_places_; ++i) {
                const Kept k = kept(nearest, i, false);
                if (k.values.empty() || missed(c, k) == 0) continue;
                misses += fmt::format("{}{} is {} in {}", misses.empty() ? "" : "; ", c.quantity,
                    quantity_text(c.quantity, k.values.at(c.quantity)), meter_.stage(i).scene_name);
                break;
            }
        base::fail("no setting of {} that was tried keeps {}: nearest comes {}, where {}; allow more, or search longer with --budget",
            base_.info->id, fmt::join(options_.under, " and "), choice_text(nearest), misses);
    }

    gpu::Device& device_;
    const TuneOptions& options_;
    Choice base_;
    Meter meter_;
    std::vector<std::string> sum_, vary_, quantities_, relative_;
    std::vector<Constraint> under_;
    SearchSpace space_;
    size_t tuning_places_ = 0;
    int repeats_ = 1;
    std::optional<base::LineFile> file_;
    std::map<std::string, Kept> known_;
    std::vector<std::string> keys_;
    base::Progress* progress_ = nullptr;
    size_t measured_ = 0, from_file_ = 0;
    std::set<std::string> of_file_; ///< keys not asked for yet
};

} // namespace

std::vector<std::string> set_names(const std::string& choice)
{
    std::vector<std::string> out;
    for (size_t at = choice.find(':'); at != std::string::npos; at = choice.find(':', at + 1))
        out.push_back(choice.substr(at + 1, choice.find('=', at) - at - 1));
    return out;
}

Tuned tune(gpu::Device& device, const TuneOptions& options) { return Tuner(device, options).run(); }

std::string tune_text(const Tuned& tuned)
{
    const Preset& p = tuned.preset;
    std::string out = fmt::format("{} after {} evaluations: {}\n", p.minimise, p.evaluations, choice_text(p.choice));
    const auto table = [&](const char* title, const std::vector<Preset::Place>& places) {
        if (places.empty()) return;
        out += fmt::format("  {:<44} {:>9} {:>9}\n", title, "before", "after");
        for (const Preset::Place& place : places)
            out += fmt::format("  {:<44} {:9.6f} {:9.6f}\n", place.scene + ", " + place.light, place.before, place.after);
        out += fmt::format("  {:<44} {:9.6f} {:9.6f}\n", "mean", mean_before(places), mean_after(places));
    };
    table("tuned on", p.tuning);
    table("held out", p.validation);
    if (!tuned.improved) out += "nothing better than the start was found\n";
    return out;
}

} // namespace gnomon::lab
