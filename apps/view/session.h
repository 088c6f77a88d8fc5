// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "picture.h"
#include "reload.h"
#include "text.h"
#include "truth_worker.h"
#include "view.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::view {

enum class Against { nothing, truth, technique };

/// A sentence for the user.
struct Message {
    std::string text;
    bool error = false;
};

/// What the window shows and what can be done with it, without the window: panels and keys call these functions.
class Session {
public:
    /// `wake` is called from another thread when there is more of the truth. Throws base::Error where the options cannot be met.
    Session(gpu::Device&, const Options&, std::function<void()> wake);

    /// Runs an action; what goes wrong becomes the message, and all stays as it was.
    void attempt(const std::function<void()>&);
    void say(std::string text) { message = {std::move(text), false}; }

    void open(const std::string& scene); ///< with its first camera and light
    void technique(const std::string& id); ///< with the parameters that it had when last shown
    void compare_with(Against, const std::string& id = {});
    void camera(const scene::Camera&);
    void camera(const std::string& text); ///< as --camera
    void light(size_t index, const scene::Light&);
    void light(size_t index, const std::string& text); ///< as --light
    void time(double seconds); ///< loads the scene as it is then, with this camera and these lights
    double time() const { return options_.load.time; }
    double duration() const { return duration_; } ///< of the scene's longest animation; 0: nothing moves
    void size(base::Size);
    void reset_parameters(); ///< of the left side
    void inspect_next(); ///< the next image that the technique offers, or none after the last

    /// Draws what has changed. `moving`: something is being dragged, so that a slow picture may be coarser and truth waits.
    void update(bool moving);

    std::string command() const; ///< the `gnomon render` line of the left side
    void save_preset(const std::filesystem::path&) const;
    void load_preset(const std::filesystem::path&);
    /// The left side as `gnomon render` writes it where it is shown lit and alone, else what is shown. Returns the file.
    std::filesystem::path screenshot(const std::string& file) const;

    std::string reload_shaders(); ///< recompiles what has changed in the source tree; says what it did

    const lab::Stage& stage() const { return loaded_->stage; }
    const std::string& scene_name() const { return options_.scene; }
    base::Size full_size() const { return size_; }
    const std::string& camera_words() const { return camera_; }
    const std::vector<std::string>& light_words() const { return lights_; }
    gpu::Device& device() const { return device_; }
    Picture& picture() const { return *loaded_->picture; }
    bool coarse() const { return coarse_; }
    std::string standing_error() const; ///< why a side cannot be drawn as it is; "" = none
    int truth_samples() const; ///< so far; 0: none
    bool truth_finished() const;
    bool truth_moved() const; ///< there is more of it than what is drawn

    lab::Choice left, right;
    Against against = Against::nothing;
    Look look;
    OverlayWish overlays; ///< all but the footprint, which `look` decides
    bool coarse_while_moving = true;
    float ambient = 0.45f;
    Message message;
    std::map<std::string, double> times; ///< moving means of passes, ms
    std::vector<std::string> time_order;
    int timed = 0; ///< pictures in these means
    double draw_ms = 0; ///< moving mean of a whole picture
    double drawn_ms = 0; ///< the last picture

private:
    /// Members are destroyed from the last to the first: each uses those before it.
    struct Loaded {
        lab::Stage stage;
        std::unique_ptr<shadow::SceneGpu> scene;
        std::unique_ptr<Picture> picture;
        std::unique_ptr<TruthWorker> truth;
    };
    void load(const lab::StageOptions&, bool same_file = false);
    void aim(base::Size);
    Wish wish() const;
    bool wants_coarse(bool moving) const;
    void ask_for_truth(bool moving);
    void add_times(double ms);
    std::shared_ptr<const TruthWorker::Result> current_truth() const;

    gpu::Device& device_;
    std::function<void()> wake_;
    lab::StageOptions options_;
    std::unique_ptr<Loaded> loaded_;
    base::Size size_;
    std::string camera_;
    std::vector<std::string> lights_;
    std::vector<LightOrigin> origins_;
    std::map<std::string, shadow::ParamValues> kept_; ///< of techniques shown before
    std::string truth_key_;
    std::shared_ptr<const TruthWorker::Result> truth_; ///< what the drawn right side came from
    ShaderSources shaders_;
    double duration_ = 0;
    double full_ms_ = 0; ///< of the last picture that was not coarse
    bool coarse_ = false;
};

} // namespace gnomon::view
