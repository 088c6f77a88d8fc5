// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/masonry.h"

namespace gnomon::scene::generators {

std::vector<vec2> arch_head(float width, float spring, float rise, int count)
{
    // Each side is an arc about a centre on the springing line; radius r puts the apex at sqrt(r^2 - (r - w/2)^2) = rise * width.
    const float half = 0.5f * width;
    const float height = std::max(rise * width, half);
    const float r = (half * half + height * height) / (2.0f * half);
    const float sweep = glm::degrees(std::atan2(height, r - half));
    std::vector<vec2> right = arc({half - r, spring}, r, 0.0f, sweep, count);
    right.back() = {0.0f, spring + height};
    std::vector<vec2> head = right;
    for (size_t i = right.size() - 1; i-- > 0;) head.push_back({-right[i].x, right[i].y});
    return head;
}

void add_arched_wall(MeshBuilder& b, const ArchedWall& w)
{
    const float half = 0.5f * w.width, gap = 0.5f * w.opening, depth = 0.5f * w.depth;
    if (w.sill > w.bottom) b.box({0, 0.5f * (w.bottom + w.sill), 0}, {half, 0.5f * (w.sill - w.bottom), depth});
    const float pier = 0.5f * (half - gap);
    for (float side : {-1.0f, 1.0f}) b.box({side * (gap + pier), 0.5f * (w.sill + w.spring), 0}, {pier, 0.5f * (w.spring - w.sill), depth});
    std::vector<vec2> outline = {{half, w.spring}, {half, w.top}, {-half, w.top}, {-half, w.spring}};
    const std::vector<vec2> head = arch_head(w.opening, w.spring, w.rise, 9);
    outline.insert(outline.end(), head.rbegin(), head.rend());
    b.extrude(outline, w.depth);
}

void add_arch_moulding(MeshBuilder& b, const ArchedWall& w, float thick, float proud)
{
    std::vector<vec3> path = {{0.5f * w.opening, w.sill, 0}};
    for (vec2 p : arch_head(w.opening, w.spring, w.rise, 9)) path.emplace_back(p.x, p.y, 0.0f);
    path.emplace_back(-0.5f * w.opening, w.sill, 0.0f);
    const float x = 0.5f * w.depth + proud, y = thick;
    // side = z; the path runs counter-clockwise, so cross(tangent, side) points away from the opening.
    b.sweep(path, {{-x, -0.02f}, {x, -0.02f}, {x, 0.6f * y}, {x - 0.5f * proud, y}, {-x + 0.5f * proud, y}, {-x, 0.6f * y}}, vec3(0, 0, 1));
}

void add_column(MeshBuilder& b, float r, float height, int around)
{
    b.box({0, 0.15f * r, 0}, {1.45f * r, 0.15f * r, 1.45f * r}, 0.04f * r);
    const float shoulder = height - 1.3f * r;
    b.lathe(
        {{0, 0.3f * r}, {1.36f * r, 0.3f * r}, {1.42f * r, 0.42f * r}, {1.36f * r, 0.55f * r}, {1.15f * r, 0.62f * r},
            {1.12f * r, 0.75f * r}, {1.2f * r, 0.84f * r}, {1.12f * r, 0.94f * r}, {r, 1.0f * r}, {0.97f * r, 0.5f * height},
            {0.88f * r, shoulder}, {0.98f * r, shoulder + 0.05f * r}, {0.98f * r, shoulder + 0.16f * r}, {0.9f * r, shoulder + 0.2f * r},
            {0.98f * r, shoulder + 0.5f * r}, {1.22f * r, shoulder + 0.85f * r}, {1.32f * r, height - 0.36f * r}, {0, height - 0.36f * r}},
        around);
    b.box({0, height - 0.18f * r, 0}, {1.5f * r, 0.18f * r, 1.5f * r}, 0.05f * r);
}

} // namespace gnomon::scene::generators
