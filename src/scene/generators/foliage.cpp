// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/foliage.h"

namespace gnomon::scene::generators {

namespace {

vec3 any_side(vec3 direction)
{
    return glm::normalize(glm::cross(direction, std::abs(direction.y) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0)));
}

vec3 turned_about(vec3 v, vec3 axis, float angle) { return vec3(glm::rotate(mat4(1.0f), angle, axis) * vec4(v, 0.0f)); }

class Grower {
public:
    Grower(MeshBuilder& wood, const TreeShape& shape, int per_twig)
        : wood_(wood)
        , shape_(shape)
        , per_twig_(per_twig)
        , random_(shape.seed)
    {
    }

    void branch(int level, vec3 foot, vec3 direction, float length, float radius)
    {
        const bool last = level == shape_.levels;
        const int steps = std::max(2, 6 - level);
        std::vector<vec3> path = {foot};
        vec3 d = direction;
        for (int i = 0; i < steps; ++i) {
            const vec3 wander(random_.between(-1, 1), random_.between(-1, 1), random_.between(-1, 1));
            d = glm::normalize(d + (level == 0 ? 0.07f : 0.2f) * wander + vec3(0, level == 0 ? 0.1f : shape_.lift / float(steps), 0));
            path.push_back(path.back() + d * (length / float(steps)));
        }
        if (level == 0) path.front().y -= 0.3f; // rooted below uneven ground
        constexpr int around[] = {10, 7, 5, 4, 3, 3};
        wood_.tube(path, level == 0 ? 1.25f * radius : radius, radius * (last ? 0.35f : 0.6f), around[std::min(level, 5)]);
        if (last)
            leaves(path);
        else
            children(level, path, length, radius);
    }

    std::vector<Twig> twigs() && { return std::move(twigs_); }

private:
    void leaves(const std::vector<vec3>& path)
    {
        for (int i = 0; i < per_twig_; ++i) {
            const float t = (float(i) + random_.next()) / float(per_twig_) * float(path.size() - 1);
            const auto k = std::min(size_t(t), path.size() - 2);
            const vec3 along = glm::normalize(path[k + 1] - path[k]);
            const vec3 out = turned_about(any_side(along), along, 2.0f * pi * random_.next());
            twigs_.push_back({glm::mix(path[k], path[k + 1], t - float(k)), glm::normalize(0.6f * along + out)});
        }
    }

    void children(int level, const std::vector<vec3>& path, float length, float radius)
    {
        const int count = level == 0 ? shape_.branches : std::max(3, shape_.branches - 2 - level);
        const float turn = 2.0f * pi * random_.next();
        for (int i = 0; i < count; ++i) {
            // Golden-angle spacing keeps branches from lining up.
            const float from = level == 0 ? 0.45f : 0.3f;
            const float t = from + (1.0f - from) * (float(i) + 0.6f) / float(count);
            const float place = t * float(path.size() - 1);
            const auto k = std::min(size_t(place), path.size() - 2);
            const vec3 along = glm::normalize(path[k + 1] - path[k]);
            const vec3 side = turned_about(any_side(along), along, turn + 2.39996f * float(i));
            const float angle = glm::radians(shape_.spread) * (1.15f - 0.55f * t) * random_.between(0.85f, 1.15f);
            const vec3 out = std::cos(angle) * along + std::sin(angle) * side;
            const float size = (level == 0 ? 0.9f : 1.0f) * (1.15f - 0.45f * t) * random_.between(0.85f, 1.1f);
            branch(level + 1, glm::mix(path[k], path[k + 1], place - float(k)), out, length * shape_.reach * size,
                radius * 0.55f * (1.1f - 0.3f * t));
        }
    }

    MeshBuilder& wood_;
    const TreeShape& shape_;
    int per_twig_;
    Random random_;
    std::vector<Twig> twigs_;
};

vec3 foliage_normal(vec3 p, vec3 crown, vec3 face)
{
    const vec3 out = glm::normalize(p - crown + vec3(0, 0.3f, 0));
    return glm::normalize(out + 0.5f * (glm::dot(face, out) < 0.0f ? -face : face));
}

} // namespace

std::vector<Twig> grow_tree(MeshBuilder& wood, const TreeShape& shape, int per_twig)
{
    Grower grower(wood, shape, per_twig);
    grower.branch(0, vec3(0), vec3(0, 1, 0), shape.trunk, shape.radius);
    return std::move(grower).twigs();
}

void add_leaf_card(MeshBuilder& b, const Twig& twig, float size, vec3 crown, Random& random)
{
    const vec3 along = glm::normalize(twig.along + vec3(0, -0.25f, 0));
    const vec3 side = turned_about(any_side(along), along, 2.0f * pi * random.next());
    const vec3 face = glm::cross(side, along);
    const float half = 0.5f * size;
    b.tint = vec3(random.between(0.72f, 1.0f), random.between(0.8f, 1.0f), random.between(0.65f, 0.95f));
    const auto corner = [&](float u, float v) {
        const vec3 p = twig.foot + side * (2.0f * u - 1.0f) * half + along * v * size - face * (0.35f * size * v * v);
        return b.add({p, foliage_normal(p, crown, face), vec2(u, 1.0f - v)});
    };
    const uint32_t p[6] = {corner(0, 0), corner(1, 0), corner(0, 0.5f), corner(1, 0.5f), corner(0, 1), corner(1, 1)};
    for (int row : {0, 2}) {
        b.triangle(p[row], p[row + 1], p[row + 3]);
        b.triangle(p[row], p[row + 3], p[row + 2]);
    }
}

void add_leaf(MeshBuilder& b, const Twig& twig, float size, vec3 crown, Random& random)
{
    const vec3 along = glm::normalize(twig.along + 0.8f * vec3(random.between(-1, 1), random.between(-1, 0.6f), random.between(-1, 1)));
    const vec3 side = turned_about(any_side(along), along, 2.0f * pi * random.next());
    const vec3 face = glm::cross(side, along);
    const vec3 foot = twig.foot + 0.4f * size * vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
    b.tint = random.between(0.7f, 1.05f) * vec3(random.between(0.8f, 1.05f), 1.0f, random.between(0.7f, 1.0f));
    const auto corner = [&](float x, float y) {
        const vec3 p = foot + size * (x * side + y * along - 0.25f * std::abs(x) * face);
        return b.add({p, foliage_normal(p, crown, face), vec2(x + 0.5f, y)});
    };
    const uint32_t p[4] = {corner(0, 0), corner(-0.32f, 0.5f), corner(0.32f, 0.5f), corner(0, 1)};
    b.triangle(p[0], p[2], p[1]);
    b.triangle(p[1], p[2], p[3]);
}

void add_grass(MeshBuilder& b, int count, float radius, float height, Random& random)
{
    for (int i = 0; i < count; ++i) {
        const float r = radius * std::sqrt(random.next()), a = 2.0f * pi * random.next(), turn = pi * random.next();
        const vec3 foot(r * std::cos(a), -0.03f, r * std::sin(a));
        const float h = height * random.between(0.6f, 1.15f), w = 0.6f * h;
        b.tint = vec3(random.between(0.75f, 1.0f), random.between(0.85f, 1.0f), random.between(0.6f, 0.85f));
        for (int k = 0; k < 2; ++k) {
            const float t = turn + 0.5f * pi * float(k);
            const vec3 side(std::cos(t), 0, std::sin(t));
            const auto corner = [&](float u, float v) {
                return b.add({foot + side * (2.0f * u - 1.0f) * w + vec3(0, v * h, 0), vec3(0, 1, 0), vec2(u, 1.0f - v)});
            };
            const uint32_t p[4] = {corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)};
            b.triangle(p[0], p[1], p[3]);
            b.triangle(p[0], p[3], p[2]);
        }
    }
}

void add_rock(MeshBuilder& b, vec3 half, int around, uint32_t seed)
{
    const auto bulge = [&](vec3 n) {
        // Planes cut off the sphere: facets, as broken stone has them.
        float r = 1.0f;
        for (uint32_t i = 0; i < 14; ++i) {
            const vec3 cut = glm::normalize(vec3(hash01(seed, i, 1) - 0.5f, hash01(seed, i, 2) - 0.5f, hash01(seed, i, 3) - 0.5f));
            const float d = glm::dot(n, cut);
            if (d > 0.05f) r = std::min(r, (0.62f + 0.25f * hash01(seed, i, 4)) / d);
        }
        return n * r * half + vec3(0, 0.55f * half.y, 0);
    };
    const auto direction = [](float u, float v) {
        const float r = v <= 0.0f || v >= 1.0f ? 0.0f : std::sin(pi * v);
        return vec3(r * std::cos(2.0f * pi * u), -std::cos(pi * v), -r * std::sin(2.0f * pi * u));
    };
    b.patch(
        around, std::max(3, around / 2),
        [&](float u, float v) {
            const vec3 n = direction(u, v), side = any_side(n), other = glm::cross(n, side);
            const vec3 p = bulge(n);
            const vec3 slope = glm::cross(bulge(glm::normalize(n + 0.04f * side)) - p, bulge(glm::normalize(n + 0.04f * other)) - p);
            return Vertex{p, glm::normalize(slope), vec2(4.0f * u * half.x, 2.0f * v * half.y)};
        },
        true);
}

} // namespace gnomon::scene::generators
