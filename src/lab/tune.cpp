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
        , terms_(parse_terms(options.minimise))
        , vary_(varied())
        , space_(base_.params, vary_)
    {
        for (const std::string& text : options.under) under_.push_back(parse_constraint(text));
        for (const std::vector<std::string>& term : terms_)
            for (const std::string& q : term) note(q, is_cost(q));
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
                    if (r.violation > 0) return;
                    incumbents_.push_back(p);
                    if (options_.validation.empty()) write_preset(options_.preset, preset(p));
                }});
        if (found.reading.violation > 0) refuse(found);
        Tuned out{preset(found.best), better(found.reading, found.start), true, 0, 0};
        if (!options_.validation.empty()) validate(start, out);
        if (out.written) write_preset(options_.preset, out.preset);
        out.measured = measured_, out.kept = from_file_;
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
        if (!tuning && (opened.scene.tuning || !opened.scene.validation))
            base::fail("{} may not decide what is kept: it is a scene {}; validate on scene files with \"validation\": true, as "
                       "experiments/validation/*.json",
                stage.scene, opened.scene.tuning ? "for tuning" : "of published tables");
        if (const std::string reason = unmeasurable(base_, device_, opened.lights.front()); !reason.empty()) base::fail("{}", reason);
    }

    std::string key(const Choice& choice, size_t place)
    {
        if (keys_.size() <= place) keys_.resize(meter_.places());
        if (keys_[place].empty()) keys_[place] = meter_.key(place);
        base::Hasher h;
        h.text("tune 2").text(keys_[place]).text(choice.info->id).text(choice.params.json().dump()).text(base_.params.json().dump());
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
            // other work on the machine makes times longer and never shorter
            for (int again = 0; again < 2 && too_slow(now); ++again) {
                now.reference["time"] = std::min(now.reference["time"], meter_.measure_time(place, base_, repeats_).technique_ms);
                now.values["time"] = std::min(now.values["time"], meter_.measure_time(place, choice, repeats_).technique_ms);
            }
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

    bool too_slow(const Kept& kept) const
    {
        return std::any_of(
            under_.begin(), under_.end(), [&](const Constraint& c) { return c.quantity == "time" && c.relative && missed(c, kept) > 0; });
    }

    double sum(const std::vector<std::string>& term, const Kept& kept) const
    {
        double out = 0;
        for (const std::string& q : term) out += is_cost(q) ? ratio(kept.values.at(q), kept.reference.at(q)) : kept.values.at(q);
        return out;
    }

    /// As parts of what the start errs there, so that no scene outweighs the others. Both get an addend, a thousandth of the picture's
    /// pixels: what errs less is all right, and ratios of a few pixels are noise.
    std::vector<double> ratios_of(const Kept& now, const Kept& start) const
    {
        constexpr double few = 1e-3;
        std::vector<double> out;
        for (const std::vector<std::string>& term : terms_) out.push_back((sum(term, now) + few) / (sum(term, start) + few));
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
        Reading out;
        for (const double r : ratios_of(k, kept(base_, place, true))) out.value += r / double(terms_.size());
        for (const Constraint& c : under_) out.violation += missed(c, k);
        return out;
    }

    std::vector<Preset::Place> places(const Choice& after, size_t from, size_t to)
    {
        std::vector<Preset::Place> out;
        for (size_t i = from; i < to; ++i) {
            const Kept before = kept(base_, i, true), now = kept(after, i, false);
            const Stage& stage = meter_.stage(i);
            Preset::Place place{
                stage.scene_name, stage.camera.name, meter_.light_name(i), stage.view.size, {}, {}, ratios_of(now, before), 0};
            for (const std::vector<std::string>& term : terms_)
                for (const std::string& q : term) place.before[q] = before.values.at(q), place.after[q] = now.values.at(q);
            if (now.reference.count("time")) place.time_ratio = ratio(now.values.at("time"), now.reference.at("time"));
            out.push_back(place);
        }
        return out;
    }

    /// Early stopping: of the settings that were the best in turn, the one that errs least in validation. The later ones fit the scenes of
    /// the search more closely, and others not always.
    void validate(const Point& start, Tuned& out)
    {
        std::optional<Reading> least;
        for (size_t i = tuning_places_; i < meter_.places(); ++i) read(start, i, true);
        for (const Point& point : incumbents_) {
            Reading mean;
            for (size_t i = tuning_places_; i < meter_.places(); ++i) {
                const Reading r = read(point, i, false);
                mean.value += r.value / double(meter_.places() - tuning_places_), mean.violation += r.violation;
            }
            if (mean.violation > 0 || (least && !better(mean, *least))) continue;
            least = mean;
            out.preset = preset(point);
            out.preset.validation = places(out.preset.choice, tuning_places_, meter_.places());
        }
        out.written = ratios(out.preset.validation).gained();
    }

    Preset preset(const Point& point)
    {
        Preset out{.choice = {base_.info, space_.params(point)}, .vary = vary_, .minimise = options_.minimise, .under = options_.under};
        out.reference = options_.reference;
        out.tuning = places(out.choice, 0, tuning_places_);
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
    std::vector<std::vector<std::string>> terms_;
    std::vector<std::string> vary_, quantities_, relative_;
    std::vector<Constraint> under_;
    SearchSpace space_;
    size_t tuning_places_ = 0;
    std::vector<Point> incumbents_; ///< those that were the best in turn and keep all bounds
    int repeats_ = 1;
    std::optional<base::LineFile> file_;
    std::map<std::string, Kept> known_;
    std::vector<std::string> keys_;
    base::Progress* progress_ = nullptr;
    size_t measured_ = 0, from_file_ = 0;
    std::set<std::string> of_file_; ///< keys not asked for yet
};

} // namespace

Tuned tune(gpu::Device& device, const TuneOptions& options) { return Tuner(device, options).run(); }

} // namespace gnomon::lab
