// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/render.h"
#include "side.h"
#include "truth_worker.h"

namespace gnomon::view {

/// What of the picture is shown, by the numbers of composite.shared.h.
const std::vector<std::string>& show_names();

/// Everything that the drawn sides depend on.
struct Wish {
    const lab::Stage& stage;
    const lab::Choice& left;
    const lab::Choice* right = nullptr; ///< another technique
    const TruthWorker::Result* truth = nullptr; ///< where the right side is the truth: what there is of it
    bool against_truth = false;
    float ambient = 0.45f;
    OverlayWish overlays{}; ///< of the left side
};

/// How they are shown.
struct Look {
    uint32_t show = 0;
    float split = 0.5f; ///< of the width
    float exposure = 0; ///< stops
    float range = 1;
    bool wireframe = false;
};

/// The two sides of the window's picture, drawn anew only where what they depend on has changed.
class Picture {
public:
    explicit Picture(gpu::Device&, shadow::SceneGpu&);
    /// True where the left side was drawn anew. Does not throw for what a side cannot draw: Side::error has it.
    bool draw(const Wish&);
    void compose(const Wish&, const Look&); ///< after draw
    void draw_again(); ///< at the next `draw`, for its times: the first picture of a technique makes pipelines
    void forget(); ///< draw all of it again, with new techniques

    gpu::Image& canvas() { return canvas_; }
    gpu::Image& insets() { return overlays_.insets_image; }
    const Overlays& overlays() const { return overlays_; }
    const Side& left() const { return left_; }
    const Side& right() const { return right_; }
    const std::vector<gpu::PassTime>& receiver_times() const { return receiver_times_; }
    const std::vector<gpu::PassTime>& compose_times() const { return compose_times_; }
    base::Picture radiance(); ///< the left side's, RGB
    base::Picture shown(); ///< the canvas, RGB, encoded for the screen

private:
    void draw_receivers(const Wish&, const std::string& key);
    void draw_truth(const Wish&, const std::string& key);
    uint32_t right_kind(const Wish&) const;

    gpu::Device& device_;
    shadow::SceneGpu& scene_;
    Receivers receivers_;
    Side left_, right_;
    std::string receivers_key_, overlays_key_;
    std::vector<gpu::PassTime> receiver_times_, compose_times_;
    Overlays overlays_;
    gpu::Image canvas_, dummy_, dummy_ids_, truth_primitive_;
};

} // namespace gnomon::view
