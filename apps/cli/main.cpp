// SPDX-License-Identifier: Apache-2.0
#include "last_words.h"
#include "options.h"
#include "usage.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>

namespace {

using namespace gnomon;

void add_sweep(CLI::App& app, cli::Sweep& sweep)
{
    app.add_option("experiment", sweep.experiment, "The experiment file (docs/experiments.md)")->required();
    app.add_option("-o,--output", sweep.output, "Folder for the results (default: experiments/results/DEVICE/EXPERIMENT in the checkout)");
    app.add_option("--shard", sweep.shard, "Make only part I of N, as 2/3; `gnomon merge` puts the parts together");
    app.add_flag("--again", sweep.again, "Measure finished runs anew");
    app.add_flag("--plan", sweep.plan, "List the runs and make none");
    cli::add_common(app, sweep.common);
}

void add_merge(CLI::App& app, cli::Merge& merge)
{
    app.add_option("experiment", merge.experiment, "The experiment file")->required();
    app.add_option("files", merge.files, "The shards' results.I-of-N.jsonl files")->required();
    app.add_option("-o,--output", merge.output, "Folder for results, tables and plots (default: that of the first file)");
    cli::add_common(app, merge.common, false);
}

void add_tune(CLI::App& app, cli::Tune& tune)
{
    app.add_option("technique", tune.technique, "Technique, by its id; parameters after colons are where the search begins, and stay")
        ->required();
    app.add_option("scenes", tune.scenes, "Scene files that say \"tuning\": true, as experiments/tuning/*.json")->required();
    app.add_option("--vary", tune.vary, "Parameters to search (default: all that are not set after a colon)")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--light", tune.lights, "A light for every scene, as elsewhere (default: each scene's first); may be repeated")
        ->allow_extra_args(false);
    app.add_option("--camera", tune.cameras, "A camera for every scene, as elsewhere (default: each scene's first); may be repeated")
        ->allow_extra_args(false);
    app.add_option("--minimise,--minimize", tune.minimise, "Sums of metrics that are to be small, each as a part of what it was")
        ->capture_default_str();
    app.add_option("--under", tune.under, "A bound, as time<2x (of the start's), bytes<64MiB, leak<0.001; may be repeated")
        ->allow_extra_args(false);
    app.add_option("--reference", tune.reference, "The technique that filter metrics are measured against");
    app.add_option("--budget", tune.budget, "Evaluations, each on all scenes")->check(CLI::Range(1, 100000))->capture_default_str();
    app.add_option("--seed", tune.seed, "Another one searches elsewhere")->check(CLI::NonNegativeNumber)->capture_default_str();
    app.add_option("--validate", tune.validation, "Scene files that say \"validation\": true, which decide whether the preset is written");
    app.add_option("--size", tune.size, "Width and height in pixels")->capture_default_str();
    app.add_option("--truth-samples", tune.truth_samples, "Light samples a pixel of the truth")
        ->check(CLI::Range(1, 1 << 20))
        ->capture_default_str();
    app.add_option("-o,--output", tune.output, "The preset, a .json file")->required();
    cli::add_common(app, tune.common);
}

void add_advise(CLI::App& app, cli::Advise& advise)
{
    app.add_option("scenes", advise.scenes, "Built-in scenes, .glb or .gltf files, or scene .json files")->required();
    app.add_option("--camera", advise.picture.camera, "A camera of the scene by name, or eye=x/y/z,target=x/y/z,fov=degrees, or fit");
    app.add_option("--light", advise.picture.lights, "A light of the scene by name, or kind,key=value,... (default: the first)")
        ->expected(1);
    app.add_option("--size", advise.picture.size, "Width and height in pixels")->capture_default_str();
    app.add_option("--budget", advise.budget, "4ms, 2x (of the reference's time) or 64MiB; may be repeated (default: whatever it costs)")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--prefer", advise.prefer, "exact, soft or stable techniques alone, or any")->capture_default_str();
    app.add_option("--without", advise.without, "Techniques that are no candidates")->delimiter(',')->allow_extra_args(false);
    app.add_option("--metric", advise.metric, "What an error is: metrics joined by +")->capture_default_str();
    app.add_option("--reference", advise.reference, "The technique that 2x is twice of")->capture_default_str();
    app.add_flag("--exhaustive", advise.exhaustive, "Measure all candidates at full size too, and say what the choice loses");
    app.add_option("--truth-samples", advise.truth_samples, "Light samples a pixel of the truth")
        ->check(CLI::Range(1, 1 << 20))
        ->capture_default_str();
    app.add_option("--repeats", advise.repeats, "Timed repetitions after a warm-up")->check(CLI::Range(2, 10000))->capture_default_str();
    app.add_option("-o,--output", advise.output, "Also a table of all scenes, a .md file");
    cli::add_common(app, advise.common);
}

int run(int argc, char** argv)
{
    CLI::App app{"gnomon: real-time shadows, measured against ray-traced truth", "gnomon"};
    app.set_version_flag("--version", "gnomon " GNOMON_VERSION_TEXT);
    app.require_subcommand(1);
    app.footer("Example: gnomon compare citadel --techniques shadow_map,ray_traced -o out/");

    cli::List list;
    CLI::App* list_app = app.add_subcommand("list", "Techniques, lights they take, what this device cannot run and why");
    CLI::Option* scenes_flag = list_app->add_flag("--scenes", list.scenes, "List the built-in scenes instead");
    list_app->add_flag("--qualities", list.qualities, "List what low, medium, high and exact quality are, cost and err instead")
        ->excludes(scenes_flag);
    cli::add_common(*list_app, list.common);

    cli::Render render;
    CLI::App* render_app = app.add_subcommand("render", "Make a picture");
    cli::add_picture(*render_app, render.picture);
    CLI::Option* technique = render_app->add_option("--technique", render.technique, "Technique, by its id")->capture_default_str();
    render_app
        ->add_option(
            "--quality", render.quality, "low, medium, high or exact: the technique that `gnomon list --qualities` has for the light")
        ->excludes(technique);
    render_app->add_option("-o,--output", render.output, "PNG or EXR file (default: out/SCENE.TECHNIQUE.png)");
    render_app
        ->add_option("--aov", render.aovs,
            "Also write these images, as NAME after the file's name: visibility, depth, normal, geometric_normal, albedo, surface, "
            "primitive, position, motion; of the technique's map, pixels per texel: texel_footprint, texel_footprint_perspective, "
            "texel_footprint_projection")
        ->delimiter(',');
    render_app->add_option("--samples", render.samples, "Pictures averaged for anti-aliasing")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    render_app->add_option("--frame", render.frame, "Frame number: the only clock and seed")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    render_app->add_option("--repeats", render.repeats, "Timed repetitions after a warm-up")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    render_app->add_option("--tile", render.tile, "Draw larger pictures in parts of at most so many pixels a side")
        ->check(CLI::Range(16, 16384))
        ->capture_default_str();
    cli::add_look(*render_app, render.exposure, render.ambient);
    render_app->allow_extras();
    cli::add_common(*render_app, render.common);

    cli::View view;
    CLI::App* view_app = app.add_subcommand("view", "A window: every technique and parameter, beside the truth or another technique");
    cli::add_view(*view_app, view);

    cli::Truth truth;
    CLI::App* truth_app = app.add_subcommand("truth", "Ray-traced visibility with its variance, by the CPU");
    cli::add_picture(*truth_app, truth.picture);
    truth_app->add_option("-o,--output", truth.output, "EXR file; a PNG is written beside it (default: out/SCENE.truth.exr)");
    truth_app->add_option("--samples", truth.samples, "Light samples a pixel, for lights with an area")
        ->check(CLI::Range(1, 1 << 20))
        ->capture_default_str();
    truth_app->add_flag("--transmittance", truth.transmittance, "Colour through semitransparent casters instead of visibility");
    cli::add_common(*truth_app, truth.common, false);

    cli::Compare compare;
    CLI::App* compare_app = app.add_subcommand("compare", "Techniques beside the truth: pictures, error maps, times, memory");
    cli::add_picture(*compare_app, compare.picture);
    compare_app
        ->add_option(
            "--techniques,--technique", compare.techniques, "Ids, with parameters after colons: shadow_map,shadow_map:map_size=2048:pcf=5")
        ->delimiter(',')
        ->required();
    compare_app->add_option("--reference", compare.reference,
        "A technique, with parameters after colons, that filtering is measured against: adds filter_mae and the like");
    compare_app->add_option("--motion", compare.motion,
        "Also measure how the error changes along a short sequence: camera,right=0.05 (metres a frame; up, forward; turn, tilt in "
        "degrees), "
        "light,azimuth=1, time,step=0.0333 or still; frames=8. Adds flicker, swimming and popping");
    compare_app->add_option("-o,--output", compare.output, "Folder for the page, pictures and results (default: out/compare-SCENE)");
    compare_app->add_option("--truth-samples", compare.truth_samples, "Light samples a pixel of the truth")
        ->check(CLI::Range(1, 1 << 20))
        ->capture_default_str();
    compare_app->add_option("--repeats", compare.repeats, "Timed repetitions after a warm-up")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    cli::add_common(*compare_app, compare.common);

    cli::Bench bench;
    CLI::App* bench_app = app.add_subcommand("bench", "Times, as ratios to Embree's and to a reference technique's in the same run");
    bench.picture.size = "1024x768";
    bench.picture.scene = "citadel";
    cli::add_picture(*bench_app, bench.picture);
    bench_app->get_option("scene")->required(false);
    bench_app->add_option("--techniques", bench.techniques, "Ids with parameters (default: shadow_map)")->delimiter(',');
    bench_app->add_option("--reference", bench.reference, "Technique that all are divided by")->capture_default_str();
    bench_app->add_option("--repeats", bench.repeats, "Timed repetitions after a warm-up")
        ->check(CLI::Range(2, 10000))
        ->capture_default_str();
    cli::add_common(*bench_app, bench.common);

    cli::Slice slice;
    CLI::App* slice_app
        = app.add_subcommand("slice", "The shadow value at every point of a plane through the scene, as if a receiver stood there");
    cli::add_slice(*slice_app, slice);

    cli::Export exported;
    CLI::App* export_app = app.add_subcommand("export", "A technique's shaders as GLSL, HLSL, MSL or SPIR-V, and how to run them");
    cli::add_export(*export_app, exported);

    cli::Figures figures;
    CLI::App* figures_app = app.add_subcommand("figures", "Pictures beside one another, and their page, from a figures file");
    figures_app->add_option("file", figures.file, "A figures file, as experiments/*/figures.json")->required();
    figures_app->add_option("-o,--output", figures.output, "Folder for the page and its pictures (default: the file's own)");
    cli::add_common(*figures_app, figures.common);

    cli::Curves curves;
    CLI::App* curves_app = app.add_subcommand("curves", "Plots and tables of light maps' perspective error, from its equations");
    curves_app->add_option("-o,--output", curves.output, "Folder for them (default: experiments/sampling_error in the checkout)");
    cli::add_common(*curves_app, curves.common, false);

    cli::Sweep sweep;
    cli::Merge merge;
    CLI::App *sweep_app = app.add_subcommand("sweep", "Every combination of an experiment file: results, tables, plots"),
             *merge_app = app.add_subcommand("merge", "Put the result files of a sweep's shards together");
    add_sweep(*sweep_app, sweep);
    add_merge(*merge_app, merge);

    cli::Tune tune;
    CLI::App* tune_app = app.add_subcommand("tune", "Search parameters that make an error small: writes a preset");
    add_tune(*tune_app, tune);

    cli::Advise advise;
    advise.picture.size = "640x360";
    CLI::App* advise_app = app.add_subcommand("advise", "Which technique for this scene, light and budget, and why");
    add_advise(*advise_app, advise);

    cli::Folder fresh, picture, docs, bless;
    CLI::App* new_app = app.add_subcommand("new", "Start a technique: copies the template to techniques/ID");
    new_app->add_option("id", fresh.ids, "Its id: lower-case letters, digits, underscores")->required()->expected(1);
    CLI::App* picture_app = app.add_subcommand("picture", "Make techniques' pictures and measurements");
    picture_app->add_flag("--scenes", picture.scenes, "Make the pictures of the built-in scenes instead");
    CLI::App* docs_app = app.add_subcommand("docs", "Rewrite the generated parts of the pages");
    docs_app->add_flag("--check", docs.check, "Change nothing; fail where a page is stale");
    CLI::App* bless_app = app.add_subcommand("bless", "Accept techniques' present pictures as goldens");
    bless_app->add_option("--because", bless.because, "Why they changed")->required();
    for (const auto& [sub, options] : {std::pair{picture_app, &picture}, {bless_app, &bless}})
        sub->add_option("ids", options->ids, "Technique ids (default: all)");
    for (const auto& [sub, options] : {std::pair{new_app, &fresh}, {picture_app, &picture}, {docs_app, &docs}, {bless_app, &bless}})
        cli::add_common(*sub, options->common, sub != new_app && sub != docs_app);

    cli::Convert convert;
    CLI::App* convert_app = app.add_subcommand("convert", "Turn a list of scenes with cameras and lights (scenes.json) into scene files");
    convert_app->add_option("list", convert.list, "The list")->required();
    convert_app->add_option("-o,--output", convert.output, "Folder for the scene files (default: out/scenes)");
    cli::add_common(*convert_app, convert.common, false);

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e); // --help, --version
        cli::refuse(app, e);
    }
    if (*list_app) return cli::list(list);
    if (*render_app) {
        if (!render.quality.empty() && !render_app->remaining().empty())
            cli::refuse_words(*render_app, render_app->remaining(), " (a quality has its parameters; see `gnomon list --qualities`)");
        render.parameters = cli::technique_options(*render_app, render.technique);
        return cli::render(render);
    }
    if (*view_app) {
        view.parameters = cli::technique_options(*view_app, view.technique);
        return cli::view(view);
    }
    if (*truth_app) return cli::truth(truth);
    if (*compare_app) return cli::compare(compare);
    if (*bench_app) return cli::bench(bench);
    if (*slice_app) {
        slice.parameters = cli::technique_options(*slice_app, slice.technique);
        return cli::slice(slice);
    }
    if (*export_app) return cli::export_shaders(exported);
    if (*figures_app) return cli::figures(figures);
    if (*curves_app) return cli::curves(curves);
    if (*sweep_app) return cli::sweep(sweep);
    if (*merge_app) return cli::merge(merge);
    if (*tune_app) return cli::tune(tune);
    if (*advise_app) return cli::advise(advise);
    if (*new_app) return cli::new_technique(fresh);
    if (*picture_app) return cli::picture(picture);
    if (*docs_app) return cli::docs(docs);
    if (*bless_app) return cli::bless(bless);
    return cli::convert(convert);
}

} // namespace

int main(int argc, char** argv)
{
    cli::set_last_words();
    // 1: what was asked cannot be done; 2: it was not understood; 3: a fault of the program
    try {
        return run(argc, argv);
    } catch (const cli::UsageError& e) {
        fmt::print(stderr, "gnomon: {}\n", e.what());
        return 2;
    } catch (const base::Error& e) {
        fmt::print(stderr, "gnomon: {}\n", e.what());
        return 1;
    } catch (const std::bad_alloc&) {
        std::fputs(cli::out_of_memory, stderr);
        return 1;
    } catch (const std::exception& e) {
        fmt::print(stderr, "gnomon: internal fault: {}; please report it with the command line\n", e.what());
        return 3;
    }
}
