// SPDX-License-Identifier: Apache-2.0
// A technique and a built-in scene in place of all of Gnomon's: what files and words may name, without the drivers and shaders behind it.
#include "scene/load.h"
#include "shadow/technique.h"

namespace gnomon {

namespace {

struct Params {
    float width = 0.5f;
    int map_size = 1024;
    int depth = 1;
    int bilinear = 1;
};

void describe(Params& p, shadow::Fields& fields)
{
    fields.real("width", p.width, {0, 100}, "m", "A length.");
    fields.integer("map_size", p.map_size, {16, 16384}, "texels", "A whole number.");
    fields.choice("depth", p.depth, {"d16", "d24", "d32"}, "A word.");
    fields.flag("bilinear", p.bilinear, "On or off.");
}

shadow::ParamTable params() { return shadow::param_table(describe); }

scene::Scene floor(double)
{
    scene::Scene out;
    out.name = "floor";
    out.materials.emplace_back();
    scene::Mesh mesh;
    mesh.positions = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    scene::complete(mesh);
    out.meshes.push_back(mesh);
    out.instances.emplace_back();
    return out;
}

} // namespace

namespace shadow {

std::span<const TechniqueInfo* const> techniques()
{
    static const TechniqueInfo one{.id = "stand_in", .params = params}, plain{.id = "plain", .lights = directional_lights};
    static constexpr const TechniqueInfo* list[] = {&plain, &one};
    return list;
}

} // namespace shadow

namespace scene {

const std::vector<Builtin>& builtins()
{
    static const std::vector<Builtin> table = {{"floor", "A floor.", false, true, floor}};
    return table;
}

} // namespace scene

} // namespace gnomon
