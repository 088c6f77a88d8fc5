// SPDX-License-Identifier: Apache-2.0
#include "lab/tune_runs.h"

#include "base/error.h"
#include "base/hash.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace gnomon::lab {

using Json = nlohmann::ordered_json;

TuneRuns::TuneRuns(gpu::Device& device, Meter& meter, const Choice& base, Goal goal, const std::filesystem::path& file)
    : device_(device)
    , meter_(meter)
    , base_(base)
    , goal_(std::move(goal))
    , name_(file)
    , file_(file)
{
    for (const std::vector<std::string>& term : goal_.terms)
        for (const std::string& q : term) note(q, is_cost(q));
    for (const Constraint& c : goal_.under) note(c.quantity, c.relative);
    for (const std::string& line : file_.lines()) take(line);
}

void TuneRuns::note(const std::string& quantity, bool relative)
{
    if (std::find(quantities_.begin(), quantities_.end(), quantity) == quantities_.end()) quantities_.push_back(quantity);
    if (relative) relative_.push_back(quantity);
    if (quantity == "time") repeats_ = 3;
}

std::string TuneRuns::key(const Choice& choice, size_t place)
{
    if (keys_.size() <= place) keys_.resize(meter_.places());
    if (keys_[place].empty()) keys_[place] = meter_.key(place);
    base::Hasher h;
    h.text("tune 2").text(keys_[place]).text(choice.info->id).text(choice.params.json().dump()).text(base_.params.json().dump());
    h.text(goal_.reference).text(device_.info().name).text(device_.info().driver).text(commit()).value(repeats_);
    for (const std::string& q : quantities_) h.text(q);
    return h.hex();
}

void TuneRuns::take(const std::string& line)
{
    const Json json = Json::parse(line, nullptr, false);
    const auto numbers = [&](const char* name) {
        return json.contains(name) && json[name].is_object()
            && std::all_of(json[name].begin(), json[name].end(), [](const Json& v) { return v.is_number(); });
    };
    if (!json.is_object() || !json.contains("key") || !json["key"].is_string() || !numbers("values") || !numbers("reference"))
        base::fail("{} holds a line that is no measurement of this search: {}; delete the file or name another preset", name_.string(),
            line.substr(0, 60));
    known_[json["key"].get<std::string>()] = {json["values"], json["reference"]};
    of_file_.insert(json["key"].get<std::string>());
}

const TuneRuns::Kept& TuneRuns::at(const Choice& choice, size_t place, bool start)
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
        if (timed()) reference = meter_.measure_time(place, base_, repeats_);
        if (!start && bytes_bound() && too_large(choice, place, now)) return record(k, choice, place, std::move(now));
        const Run run = meter_.measure(place, choice, repeats_);
        for (const std::string& q : quantities_) now.values[q] = quantity_of(run, q);
        for (const std::string& q : relative_)
            now.reference[q] = q == "time" ? reference.technique_ms : start ? now.values[q] : at(base_, place, true).values.at(q);
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
    return record(k, choice, place, std::move(now));
}

const TuneRuns::Kept& TuneRuns::record(const std::string& k, const Choice& choice, size_t place, Kept now)
{
    ++measured_;
    file_.append(
        Json{{"key", k}, {"choice", choice_text(choice)}, {"place", place}, {"values", now.values}, {"reference", now.reference}}.dump());
    return known_[k] = std::move(now);
}

bool TuneRuns::bytes_bound() const
{
    return std::any_of(goal_.under.begin(), goal_.under.end(), [](const Constraint& c) { return c.quantity == "bytes"; });
}

bool TuneRuns::timed() const { return std::find(relative_.begin(), relative_.end(), "time") != relative_.end(); }

bool TuneRuns::too_large(const Choice& choice, size_t place, Kept& now)
{
    Kept costs;
    costs.values["bytes"] = double(meter_.measure_time(place, choice, 1).bytes),
    costs.reference["bytes"] = at(base_, place, true).values.at("bytes");
    const bool out = std::any_of(
        goal_.under.begin(), goal_.under.end(), [&](const Constraint& c) { return c.quantity == "bytes" && missed(c, costs) > 0; });
    if (out) now = std::move(costs);
    return out;
}

bool TuneRuns::too_slow(const Kept& kept) const
{
    return std::any_of(goal_.under.begin(), goal_.under.end(),
        [&](const Constraint& c) { return c.quantity == "time" && c.relative && missed(c, kept) > 0; });
}

double TuneRuns::missed(const Constraint& c, const Kept& kept)
{
    const double limit = c.relative ? c.limit * kept.reference.at(c.quantity) : c.limit;
    return missed_by(kept.values.at(c.quantity), limit);
}

double TuneRuns::ratio(double value, double by) { return by > 0 ? value / by : value > 0 ? 1e6 : 1.0; }

} // namespace gnomon::lab
