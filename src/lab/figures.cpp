// SPDX-License-Identifier: Apache-2.0
#include "lab/figures.h"

#include "base/error.h"
#include "base/file.h"
#include "base/image_file.h"
#include "base/progress.h"
#include "lab/aov.h"
#include "lab/compare.h"
#include "metrics/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace gnomon::lab {

namespace fs = std::filesystem;

namespace {

/// A stage with all that panels of it share; neighbours in a figure mostly do.
struct Open {
    std::string text;
    Stage stage;
    std::unique_ptr<shadow::SceneGpu> scene;
    std::map<truth::Quantity, truth::Reference> truths;
};

std::string stage_text(const FigurePanel& p)
{
    return fmt::format("{}\n{}\n{}\n{}\n{}x{}", p.stage.scene, p.stage.load.detail, p.stage.camera,
        p.stage.lights.empty() ? "" : p.stage.lights.front(), p.stage.size.width, p.stage.size.height);
}

/// Without the legend strip that heat maps have below.
base::Picture top(const base::Picture& p, base::Size size)
{
    base::Picture out(size, p.channels);
    std::copy_n(p.values.begin(), out.values.size(), out.values.begin());
    return out;
}

base::Picture cropped(const base::Picture& p, const FigurePanel& panel)
{
    std::array<int, 4> c = panel.crop;
    if (c[2] <= 0 || c[3] <= 0) c = {0, 0, p.size.width, p.size.height};
    c[0] = std::clamp(c[0], 0, p.size.width - 1), c[1] = std::clamp(c[1], 0, p.size.height - 1);
    c[2] = std::min(c[2], p.size.width - c[0]), c[3] = std::min(c[3], p.size.height - c[1]);
    base::Picture out({c[2] * panel.zoom, c[3] * panel.zoom}, p.channels);
    for (int y = 0; y < out.size.height; ++y)
        for (int x = 0; x < out.size.width; ++x)
            for (int k = 0; k < p.channels; ++k) out.at(x, y, k) = p.at(c[0] + x / panel.zoom, c[1] + y / panel.zoom, k);
    return out;
}

class Artist {
public:
    Artist(gpu::Device& device, int truth_samples)
        : device_(device)
        , truth_samples_(truth_samples)
    {
    }

    void draw(const FigurePanel& panel, const fs::path& file)
    {
        Open& open = opened(panel);
        const bool is_truth = panel.technique == "truth";
        if (panel.show == Show::slice) return write(slice_of(open, panel), panel, file, base::Encoding::linear);
        if (is_truth && panel.show == Show::visibility)
            return write(truth(open, panel.quantity).visibility.mean, panel, file, base::Encoding::linear);
        if (is_truth && panel.show == Show::lit)
            return write(
                display(shade_with(device_, *open.scene, open.stage, {truth(open, panel.quantity).visibility.mean}, {}), open.stage), panel,
                file, base::Encoding::srgb);
        if (is_truth) base::fail("the panel '{}' shows an error of the truth; name a technique", panel.label);
        if (panel.show >= Show::texel_footprint) return write(footprint(open, panel), panel, file, base::Encoding::linear);
        const Rendered rendered = render(
            device_, *open.scene, open.stage, parse_choice(panel.technique), {.lit = panel.show == Show::lit, .aovs = scored_aovs});
        if (panel.show == Show::lit) return write(display(rendered.radiance, open.stage), panel, file, base::Encoding::srgb);
        if (panel.show == Show::visibility) return write(judged_channels(rendered.images.front(), 1), panel, file, base::Encoding::linear);
        write(error_of(open, panel, rendered), panel, file, base::Encoding::linear);
    }

private:
    Open& opened(const FigurePanel& panel)
    {
        if (const std::string text = stage_text(panel); !open_ || open_->text != text) {
            open_.reset(); // its scene leaves the device before the next one comes
            StageOptions options = panel.stage;
            if (panel.technique != "truth") options.kinds = parse_choice(panel.technique).info->lights;
            open_ = std::make_unique<Open>(Open{text, open_stage(options), {}, {}});
            open_->stage.lights.resize(1);
            open_->scene = std::make_unique<shadow::SceneGpu>(device_, open_->stage.scene);
        }
        return *open_;
    }

    const truth::Reference& truth(Open& open, truth::Quantity quantity) const
    {
        const auto found = open.truths.find(quantity);
        if (found != open.truths.end()) return found->second;
        return open.truths[quantity]
            = truth::reference(open.stage.scene, open.stage.view, open.stage.lights.front(), {.samples = truth_samples_}, quantity);
    }

    base::Picture slice_of(Open& open, const FigurePanel& panel) const
    {
        const Slice slice = make_slice(open.stage, panel.slice);
        const base::Picture image = panel.technique == "truth"
            ? slice_truth(open.stage, slice, panel.quantity, truth_samples_)
            : slice_image(device_, *open.scene, open.stage, slice, parse_choice(panel.technique));
        return slice_display(image, slice_outline(open.stage.scene, slice));
    }

    base::Picture footprint(Open& open, const FigurePanel& panel) const
    {
        const std::string name = panel.show == Show::texel_footprint ? "texel_footprint"
            : panel.show == Show::texel_footprint_perspective        ? "texel_footprint_perspective"
                                                                     : "texel_footprint_projection";
        return aov_display(
            name, render(device_, *open.scene, open.stage, parse_choice(panel.technique), {.lit = false, .aovs = {name}}).aovs.at(name));
    }

    base::Picture error_of(Open& open, const FigurePanel& panel, const Rendered& rendered) const
    {
        const truth::Reference& rays = truth(open, truth_quantity(parse_choice(panel.technique)));
        const base::Picture other
            = panel.show == Show::error ? rays.visibility.mean : filter_reference(device_, *open.scene, open.stage, panel.reference).image;
        const base::Picture no_variance;
        std::vector<uint8_t> mask(rays.primary.primitive.size());
        for (size_t i = 0; i < mask.size(); ++i) mask[i] = rays.primary.primitive[i] != truth::no_primitive;
        return top(metrics::signed_heat_map(
                       {judged_channels(rendered.images.front(), other.channels), other, no_variance, mask}, 1.0f / panel.gain),
            open.stage.view.size);
    }

    static void write(const base::Picture& picture, const FigurePanel& panel, const fs::path& file, base::Encoding encoding)
    {
        base::write_png(file, cropped(picture, panel), encoding);
    }

    gpu::Device& device_;
    int truth_samples_;
    std::unique_ptr<Open> open_;
};

/// A table of pictures with their labels below.
std::string figure_page(const Figure& figure, const std::vector<fs::path>& files)
{
    std::string page = fmt::format("## {}\n\n{}\n\n", figure.title, figure.text);
    const size_t columns = std::min(size_t(figure.columns), figure.panels.size());
    for (size_t first = 0; first < figure.panels.size(); first += columns) {
        std::string pictures = "|", labels = "|", rule = "|";
        for (size_t i = first; i < first + columns; ++i) {
            const bool there = i < figure.panels.size();
            pictures += there ? fmt::format(" ![{}]({}) |", figure.panels[i].label, files[i].filename().string()) : " |";
            labels += there ? fmt::format(" {} |", figure.panels[i].label) : " |";
            rule += " --- |";
        }
        page += first == 0 ? fmt::format("{}\n{}\n{}\n", pictures, rule, labels) : fmt::format("{}\n{}\n", pictures, labels);
    }
    return page + "\n";
}

} // namespace

std::vector<fs::path> draw_figures(gpu::Device& device, const Figures& figures, const fs::path& folder)
{
    Artist artist(device, figures.truth_samples);
    std::vector<fs::path> files;
    std::string page = fmt::format("# {}\n\n{}\n\n", figures.title, figures.about);
    size_t panels = 0;
    for (const Figure& figure : figures.figures) panels += figure.panels.size();
    base::Progress progress("panels", panels);
    for (const Figure& figure : figures.figures) {
        std::vector<fs::path> own;
        for (size_t i = 0; i < figure.panels.size(); ++i) {
            own.push_back(folder / fmt::format("{}.{}.png", figure.id, i + 1));
            artist.draw(figure.panels[i], own.back());
            progress.advance();
        }
        page += figure_page(figure, own);
        files.insert(files.end(), own.begin(), own.end());
    }
    page += fmt::format("Made by `gnomon figures` on {}.\n", device.info().name);
    files.push_back(folder / "README.md");
    base::write_text(files.back(), page);
    return files;
}

} // namespace gnomon::lab
