// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

// The built-in scenes, one function each. The table of their names is in table.cpp.
namespace gnomon::scene::generators {

Scene plane(double detail);
Scene tilted_planes(double detail);
Scene closed_box(double detail);
Scene half_plane(double detail);
Scene rect_blocker(double detail);
Scene disk_blocker(double detail);
Scene stacked_panes(double detail);
Scene balls(double detail);
Scene contact(double detail);
Scene open_mesh(double detail);
Scene duelling_frusta(double detail);
Scene colonnade(double detail);
Scene fence(double detail);
Scene tree(double detail);
Scene terrain(double detail);
Scene citadel(double detail);
Scene stacked(double detail);
Scene grazing(double detail);

} // namespace gnomon::scene::generators
