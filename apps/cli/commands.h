// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/stage.h"

#include <string>
#include <vector>

// One function a subcommand; main.cpp reads the options and prints errors. Each returns the exit code.
namespace gnomon::cli {

/// What every subcommand takes.
struct Common {
    std::string device; ///< part of a device's name
    bool validation = false;
    bool json = false; ///< the result as JSON on standard output
};

/// What every subcommand with a picture takes.
struct Picture {
    std::string scene, camera, size = "960x540";
    std::vector<std::string> lights;
    double time = 0, detail = 1;
    int gltf_scene = -1;
};
lab::StageOptions stage_options(const Picture&); ///< throws base::Error on a malformed size

std::string technique_id(const std::string& choice); ///< of "id:name=value", or of a preset "@file"

struct List {
    Common common;
    bool scenes = false;
};
int list(const List&);

struct Render {
    Common common;
    Picture picture;
    std::string technique = "shadow_map", output;
    std::vector<std::string> parameters, aovs; ///< name=value; aov names
    int samples = 1, frame = 0, repeats = 1;
    float exposure = 0, ambient = 0.45f; ///< stops; relative
};
int render(const Render&);

struct Truth {
    Common common;
    Picture picture;
    std::string output;
    int samples = 256;
    bool transmittance = false;
};
int truth(const Truth&);

struct Compare {
    Common common;
    Picture picture;
    std::vector<std::string> techniques;
    std::string output, reference, motion;
    int truth_samples = 256, repeats = 3;
};
int compare(const Compare&);

struct Bench {
    Common common;
    Picture picture;
    std::vector<std::string> techniques;
    std::string reference = "shadow_map:map_size=2048";
    int repeats = 10;
};
int bench(const Bench&);

struct Sweep {
    Common common;
    std::string experiment, output, shard;
    bool again = false, plan = false;
};
int sweep(const Sweep&);

struct Merge {
    Common common;
    std::string experiment, output;
    std::vector<std::string> files;
};
int merge(const Merge&);

struct Tune {
    Common common;
    std::string technique, output, reference, minimise = "leak+acne,mae", size = "320x180";
    std::vector<std::string> scenes, validation, cameras, lights, under, vary;
    int budget = 100, seed = 1, truth_samples = 64;
};
int tune(const Tune&);

struct Advise {
    Common common;
    Picture picture; ///< all but its scene
    std::vector<std::string> scenes, budget, without;
    std::string prefer = "any", metric = "mae", reference = "shadow_map:map_size=2048", output;
    bool exhaustive = false;
    int truth_samples = 64, repeats = 3;
};
int advise(const Advise&);

struct Slice {
    Common common;
    Picture picture;
    std::string technique = "shadow_map", output, centre, right, up;
    std::vector<std::string> parameters; ///< name=value
    float height = 0;
    bool truth = false;
    int truth_samples = 256;
};
int slice(const Slice&);

struct Export {
    Common common;
    std::string technique, language, output, light, scene = "fence", size = "640x360";
    std::vector<std::string> set; ///< name=value
};
int export_shaders(const Export&);

struct Figures {
    Common common;
    std::string file, output;
};
int figures(const Figures&);

struct Curves {
    Common common;
    std::string output;
};
int curves(const Curves&);

struct View {
    Common common;
    Picture picture;
    std::string technique = "shadow_map", against, state;
    std::vector<std::string> parameters; ///< name=value
    float exposure = 0, ambient = 0.45f; ///< stops; relative
    double measure = 0; ///< seconds; 0: does not
};
int view(const View&);

struct Folder {
    Common common;
    std::vector<std::string> ids; ///< empty = all techniques
    std::string because;
    bool check = false; ///< docs
    bool scenes = false; ///< picture
};
int new_technique(const Folder&);
int picture(const Folder&);
int docs(const Folder&);
int bless(const Folder&);

struct Convert {
    Common common;
    std::string list, output;
};
int convert(const Convert&);

} // namespace gnomon::cli
