// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/generators.h"
#include "scene/load.h"

namespace gnomon::scene {

const std::vector<Builtin>& builtins()
{
    static const std::vector<Builtin> table = {
        // name, help, analytic, opaque, make
        {"plane", "An empty floor: nothing may be shadowed.", false, true, generators::plane},
        {"tilted_planes", "Cards tilted by 0 to 85 degrees: self-shadowing and bias.", false, true, generators::tilted_planes},
        {"closed_box", "A sealed room with the light outside: all is dark.", false, true, generators::closed_box},
        {"half_plane", "A straight edge before area lights, with a closed form: the shape of a penumbra.", true, true,
            generators::half_plane},
        {"rect_blocker", "A level rectangle before a rectangle light, with a closed form.", true, true, generators::rect_blocker},
        {"disk_blocker", "A level disk before a disk light, with a closed form.", true, true, generators::disk_blocker},
        {"stacked_panes", "Five coloured panes that overlap: coloured shadows and their order.", false, false, generators::stacked_panes},
        {"balls", "Spheres at many heights over a floor: contact to wide penumbra.", false, true, generators::balls},
        {"contact", "Chairs, cubes, cards and papers that touch a floor and a wall: light leaking under feet.", false, true,
            generators::contact},
        {"open_mesh", "Shells, ribbons, a Moebius strip, edges of three and more faces: what closed-mesh methods assume away.", false, true,
            generators::open_mesh},
        {"colonnade", "A vaulted hall with sun through tall windows: arches, thin tracery, long shafts of light.", false, true,
            generators::colonnade},
        {"duelling_frusta", "A long colonnade lit from ahead, against the view: the worst case of perspective warps.", false, true,
            generators::duelling_frusta},
        {"tree", "Trees and grass of alpha-masked cards: shadows of things finer than a texel.", false, false, generators::tree},
        {"citadel", "A walled courtyard with towers, houses, market stalls and banners: a game level in small.", false, true,
            generators::citadel},
        {"fence", "Chain link, railings, nets and wires: casters thinner than a texel, by mask and by geometry.", false, false,
            generators::fence},
        {"terrain", "Huts, rocks and tufts before hills kilometres away: cascades and depth range.", false, false, generators::terrain},
        {"stacked", "Three thin casters at different heights that overlap, over a ground and a step: light bleeding of filtered maps.",
            false, true, generators::stacked},
        {"grazing", "Boards at 0 to 85 degrees to the sun, with casters on and before them: acne, bias and lost contact.", false, true,
            generators::grazing},
    };
    return table;
}

} // namespace gnomon::scene
