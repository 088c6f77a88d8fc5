// SPDX-License-Identifier: Apache-2.0
// Planar shadows are exact where they are defined: on the planes.
#include "lab/compare.h"
#include "scene/load.h"
#include "techniques/planar/planes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace gnomon {
namespace {

using techniques::planar::Plane;

/// Whether each primitive lies on one of the planes.
std::vector<bool> on_planes(const scene::Scene& s, const std::vector<Plane>& planes)
{
    std::vector<bool> out;
    const double thickness = techniques::planar::plane_thickness(s);
    for (const scene::Instance& instance : s.instances) {
        const scene::Mesh& mesh = s.meshes[size_t(instance.mesh)];
        for (size_t i = 0; i < mesh.indices.size(); i += 3) {
            bool found = false;
            for (const Plane& plane : planes) {
                bool all = true;
                for (size_t k = 0; k < 3; ++k) {
                    const vec4 p = instance.world_from_object * vec4(mesh.positions[mesh.indices[i + k]], 1);
                    all = all && std::abs(glm::dot(plane.equation, glm::dvec4(p))) < 0.6 * thickness;
                }
                found = found || all;
            }
            out.push_back(found);
        }
    }
    return out;
}

struct Expectation {
    const char* scene;
    double plane_pixels; ///< at least this fraction of the picture
};

class Planar : public testing::TestWithParam<Expectation> { };

TEST_P(Planar, ExactOnThePlanesOutsideTheBand)
{
    const char* name = std::getenv("GNOMON_DEVICE");
    const auto device = gpu::Device::open({.name = name ? name : "", .validation = true});
    for (const char* light : {"sun,elevation=40,azimuth=120,angle=0", "sun,elevation=12,azimuth=-70,angle=0"}) {
        for (const bool local : {false, true}) {
            lab::Stage stage = lab::open_stage({GetParam().scene, {}, "", {light}, {240, 135}});
            if (local) // among the things of the scene, so that some of them are past the light
                stage = lab::open_stage({GetParam().scene, {}, "",
                    {"point,radius=0,intensity=1,position=" + std::to_string(stage.camera.target.x + 0.3f) + "/"
                        + std::to_string(stage.camera.target.y + 0.9f) + "/" + std::to_string(stage.camera.target.z + 0.2f)},
                    {240, 135}});
            shadow::SceneGpu scene(*device, stage.scene);
            lab::Rendered rendered
                = lab::render(*device, scene, stage, lab::parse_choice("planar"), {.lit = false, .aovs = lab::scored_aovs});
            truth::Reference truth = truth::reference(stage.scene, stage.view, stage.lights.front(), {.samples = 1});

            const std::vector<bool> flat = on_planes(stage.scene, techniques::planar::find_planes(stage.scene, 8, 0.01));
            size_t plane_pixels = 0;
            for (size_t i = 0; i < truth.primary.primitive.size(); ++i) {
                const uint32_t primitive = truth.primary.primitive[i];
                if (primitive != truth::no_primitive && flat[primitive])
                    ++plane_pixels;
                else
                    truth.primary.primitive[i] = rendered.primitive[i] = truth::no_primitive; // not scored
            }
            EXPECT_GE(double(plane_pixels), GetParam().plane_pixels * 240 * 135);
            lab::Run run;
            lab::score(stage, stage.lights.front(), truth, rendered, run);
            EXPECT_EQ(run.metrics.at("wrong_outside_band") * double(run.scored_pixels), 0.0) << light << (local ? ", point" : "");
        }
    }
    EXPECT_TRUE(device->validation_errors().empty());
}

// `fence` casts through masks; its ground is uneven, so that little of it is plane.
INSTANTIATE_TEST_SUITE_P(Scenes, Planar,
    testing::Values(Expectation{"plane", 0.2}, Expectation{"contact", 0.5}, Expectation{"balls", 0.3}, Expectation{"tilted_planes", 0.2},
        Expectation{"closed_box", 0.3}, Expectation{"open_mesh", 0.1}, Expectation{"colonnade", 0.02}, Expectation{"fence", 0.015},
        Expectation{"stacked", 0.2}, Expectation{"grazing", 0.2}, Expectation{"duelling_frusta", 0.1}),
    [](const auto& p) { return std::string(p.param.scene); });

} // namespace
} // namespace gnomon
