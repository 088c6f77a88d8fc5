// SPDX-License-Identifier: Apache-2.0
#include "lab/compare.h"

#include "base/error.h"
#include "base/file.h"
#include "base/image_file.h"
#include "base/progress.h"
#include "lab/sequence.h"
#include "metrics/metrics.h"

#include <commit.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>

namespace gnomon::lab {

std::string_view commit() { return GNOMON_COMMIT; }

std::string unmeasurable(const Choice& choice, const gpu::Device& device, const scene::Light& light)
{
    const shadow::Output output = output_of(choice);
    const std::string reason = shadow::refusal(*choice.info, device, light);
    if (!reason.empty() || output == shadow::Output::visibility || output == shadow::Output::transmittance) return reason;
    return fmt::format("{} writes {}, which has no truth here yet", choice.info->id, shadow::output_name(output));
}

namespace {

std::string file_name(std::string text)
{
    for (char& c : text)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_' && c != '.') c = '_';
    return text;
}

/// Where no light is named, one that all techniques take, if there is one.
StageOptions with_common_lights(const CompareOptions& options)
{
    StageOptions out = options.stage;
    for (const std::string& text : options.techniques) out.kinds &= parse_choice(text).info->lights;
    if (out.kinds == 0) out.kinds = ~0u;
    return out;
}

class Comparer {
public:
    Comparer(gpu::Device& device, const CompareOptions& options)
        : device_(device)
        , options_(options)
        , stage_options_(with_common_lights(options))
        , stage_(open_stage(stage_options_))
        , scene_(device, stage_.scene)
    {
        for (const std::string& text : options.techniques) choices_.push_back(parse_choice(text));
        if (choices_.empty()) base::fail("no technique to compare; name some with --techniques a,b (see `gnomon list`)");
        if (!options.reference.empty()) parse_choice(options.reference);
        if (!options.motion.empty()) motion_ = parse_motion(options.motion);
        out_.device = device.info().name, out_.driver = device.info().driver, out_.commit = commit();
    }

    Comparison run()
    {
        base::Progress progress("compare " + stage_.scene_name, stage_.lights.size() * (choices_.size() + 1));
        const std::vector<scene::Light> lights = stage_.lights;
        for (size_t i = 0; i < lights.size(); ++i) {
            stage_.lights = {lights[i]};
            light_ = lights[i].name.empty() ? std::string(scene::kind_name(lights[i].kind())) + std::to_string(i) : lights[i].name;
            run_light(lights[i], progress);
        }
        if (std::all_of(out_.runs.begin(), out_.runs.end(), [](const Run& r) { return !r.skipped.empty(); }))
            base::fail("no technique ran: {}", out_.runs.front().skipped);
        if (!options_.folder.empty()) {
            write_text("results.json", results_json(out_).dump(1) + "\n");
            write_text("results.csv", results_csv(out_));
            write_text("index.html", report_page(out_, options_.folder));
        }
        return std::move(out_);
    }

private:
    const truth::Reference& reference(truth::Quantity quantity)
    {
        auto found = references_.find(quantity);
        if (found != references_.end()) return found->second;
        return references_[quantity] = truth::reference(
                   stage_.scene, stage_.view, stage_.lights.front(), {.samples = options_.truth_samples}, quantity, options_.truth_cache);
    }

    void run_light(const scene::Light& light, base::Progress& progress)
    {
        references_.clear();
        truth_lit_.clear();
        if (!options_.reference.empty()) filter_ = filter_reference(device_, scene_, stage_, options_.reference);
        if (motion_)
            sequence_.emplace(device_, scene_, stage_, stage_options_, *motion_,
                SequenceSettings{options_.truth_samples, options_.frame_index, options_.truth_cache});
        progress.advance();
        for (const Choice& choice : choices_) {
            Run run = new_run(stage_, choice, light_);
            run.skipped = unmeasurable(choice, device_, light);
            if (run.skipped.empty()) run_choice(choice, light, run);
            out_.runs.push_back(std::move(run));
            progress.advance();
        }
    }

    void run_choice(const Choice& choice, const scene::Light& light, Run& run)
    {
        const truth::Reference& truth = reference(truth_quantity(choice));
        const Rendered rendered = render(device_, scene_, stage_, choice,
            {.repeats = options_.repeats, .frame_index = options_.frame_index, .count = true, .aovs = scored_aovs});
        base::Picture heat_map, flip_map;
        score(stage_, light, truth, rendered, run, {.filter = filter_.choice.empty() ? nullptr : &filter_, .heat_map = &heat_map});
        base::Picture& truth_lit = truth_lit_[truth_quantity(choice)];
        if (truth_lit.empty()) {
            truth_lit = display(shade_with(device_, scene_, stage_, {truth.visibility.mean}, {}), stage_);
            out_.truths.push_back({light_, truth_quantity(choice),
                {{"lit", write("truth", truth_lit, base::Encoding::srgb)},
                    {"visibility", write("truth.visibility", truth.visibility.mean, base::Encoding::linear)}}});
        }
        const base::Picture lit = display(rendered.radiance, stage_);
        run.metrics["flip"] = metrics::flip(lit, truth_lit, &flip_map);
        add_times(run, rendered);
        run.quantity = truth_quantity(choice);
        run.pictures = {{"lit", write(run.technique, lit, base::Encoding::srgb)},
            {"visibility", write(run.technique + ".visibility", judged_channels(rendered.images.front(), 1), base::Encoding::linear)},
            {"error", write(run.technique + ".error", heat_map, base::Encoding::linear)}};
        if (sequence_) {
            base::Picture change;
            sequence_->measure(choice, run, &change);
            run.pictures["change"] = write(run.technique + ".change", change_display(change), base::Encoding::linear);
        }
    }

    void write_text(const char* name, const std::string& text)
    {
        out_.files.push_back(options_.folder / name);
        base::write_text(out_.files.back(), text);
    }

    /// The file's name.
    std::string write(const std::string& name, const base::Picture& picture, base::Encoding encoding)
    {
        if (options_.folder.empty()) return {};
        // two settings of one technique must not share a file
        std::string file = file_name(light_) + "." + name;
        for (int n = 2; std::find(out_.files.begin(), out_.files.end(), options_.folder / (file + ".png")) != out_.files.end(); ++n)
            file = fmt::format("{}.{}.{}", file_name(light_), name, n);
        out_.files.push_back(options_.folder / (file + ".png"));
        base::write_png(out_.files.back(), picture, encoding);
        return file + ".png";
    }

    gpu::Device& device_;
    const CompareOptions& options_;
    const StageOptions stage_options_;
    Stage stage_;
    shadow::SceneGpu scene_;
    std::vector<Choice> choices_;
    std::map<truth::Quantity, truth::Reference> references_;
    std::map<truth::Quantity, base::Picture> truth_lit_;
    std::optional<Motion> motion_;
    std::optional<Sequence> sequence_; ///< of the present light
    FilterReference filter_; ///< of the present light
    std::string light_;
    Comparison out_;
};

} // namespace

Comparison compare(gpu::Device& device, const CompareOptions& options) { return Comparer(device, options).run(); }

} // namespace gnomon::lab
