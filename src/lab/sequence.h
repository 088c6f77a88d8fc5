// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/compare.h"
#include "lab/motion.h"

namespace gnomon::lab {

struct SequenceSettings {
    int truth_samples = 256;
    uint32_t frame_index = 0; ///< of the first frame
    std::filesystem::path truth_cache; ///< empty = the user's cache
};

/// A motion through a stage with one light, and the truth of every frame: judges techniques by how their error changes. One technique
/// object sees the whole sequence while scene and light stay; a light that moved or a scene at another time is a new object in each frame,
/// as shadow/technique.h says, so that nothing is kept there.
class Sequence {
public:
    /// `options` is what `stage` was opened with: a motion of time opens the scene anew for each frame. The stage must outlive this; while
    /// a light moves, `measure` puts its lights in the stage. Throws base::Error where the motion does not suit light or scene.
    Sequence(gpu::Device&, shadow::SceneGpu&, Stage&, const StageOptions& options, const Motion&, const SequenceSettings&);

    /// Adds flicker, swimming, popping, for soft lights temporal_noise, and the frames' numbers. `map`: mean change at each pixel.
    void measure(const Choice&, Run&, base::Picture* map = nullptr);

private:
    Stage at_time(int frame) const;
    void demand_animation() const;
    scene::View view(int frame) const;
    truth::Reference trace(int frame, truth::Quantity) const;
    const std::vector<truth::Reference>& truths(truth::Quantity); ///< one of all frames where nothing moves
    std::vector<Rendered> render_frames(const Choice&);

    gpu::Device& device_;
    shadow::SceneGpu& scene_;
    Stage& stage_;
    StageOptions options_;
    Motion motion_;
    SequenceSettings settings_;
    std::map<truth::Quantity, std::vector<truth::Reference>> truths_;
};

/// A map of changes to look at: white = none, full red = a quarter, as the error's heat map.
base::Picture change_display(const base::Picture& map);

/// Draws change.N.svg into `folder`: the mean change in each frame of the runs under one light. "" or, in a sentence, why there is none.
std::string draw_changes(const std::vector<Run>&, const std::string& light, const std::filesystem::path& file);

} // namespace gnomon::lab
