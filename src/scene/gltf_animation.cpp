// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_accessor.h"
#include "scene/gltf_nodes.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace gnomon::scene::gltf {
namespace {

enum class Interpolation { step, linear, cubic };

/// A checked animation sampler: keys of `width` numbers; with cubic splines each is in-tangent, value, out-tangent.
struct Sampler {
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times, values;
    size_t width = 0;
    const float* value(size_t key) const { return &values[interpolation == Interpolation::cubic ? (key * 3 + 1) * width : key * width]; }
    const float* in_tangent(size_t key) const { return &values[key * 3 * width]; }
    const float* out_tangent(size_t key) const { return &values[(key * 3 + 2) * width]; }
};

std::vector<float> read_times(Document& document, const Value& reference)
{
    const Accessor a = open_accessor(document, reference, {"SCALAR"});
    if (a.count == 0) reference.bad("names an accessor without elements");
    std::vector<float> times(a.count);
    read_floats(document, a, times.data());
    for (size_t i = 0; i < times.size(); ++i)
        if (!(std::isfinite(times[i]) && times[i] >= 0 && (i == 0 || times[i] > times[i - 1])))
            reference.bad("holds the time {} at key {}; times must be from 0 and rise", times[i], i);
    return times;
}

Sampler read_sampler(Document& document, const Value& value)
{
    Sampler out;
    const std::string name = value.text_or("interpolation", "LINEAR");
    if (name != "STEP" && name != "LINEAR" && name != "CUBICSPLINE") value.bad("has the unknown interpolation '{}'", printable(name));
    out.interpolation = name == "STEP" ? Interpolation::step : name == "LINEAR" ? Interpolation::linear : Interpolation::cubic;
    out.times = read_times(document, value.at("input"));
    const Accessor a = open_accessor(document, value.at("output"), {"SCALAR", "VEC3", "VEC4"});
    const size_t entries = out.times.size() * (out.interpolation == Interpolation::cubic ? 3 : 1), numbers = a.count * size_t(a.width);
    if (numbers == 0 || numbers % entries != 0) value.bad("has {} keys, which {} output elements do not fit", out.times.size(), a.count);
    out.width = numbers / entries;
    out.values.resize(numbers);
    read_floats(document, a, out.values.data());
    for (const float number : out.values)
        if (!std::isfinite(number)) a.value.bad("holds a number that is not finite");
    return out;
}

dquat as_quat(const float* v) { return dquat(double(v[3]), double(v[0]), double(v[1]), double(v[2])); }

std::vector<double> sample(const Sampler& s, double time, bool rotation)
{
    std::vector<double> out(s.width);
    const auto copy = [&](size_t key) { std::copy_n(s.value(key), s.width, out.begin()); };
    const size_t after = size_t(std::ranges::upper_bound(s.times, time, {}, [](float t) { return double(t); }) - s.times.begin());
    if (after == 0 || after == s.times.size()) return copy(after == 0 ? 0 : after - 1), out;
    const size_t before = after - 1;
    if (s.interpolation == Interpolation::step) return copy(before), out;
    const double span = double(s.times[after]) - double(s.times[before]), t = (time - double(s.times[before])) / span;
    const float *a = s.value(before), *b = s.value(after);
    if (s.interpolation == Interpolation::linear && rotation) {
        const dquat q = glm::slerp(glm::normalize(as_quat(a)), glm::normalize(as_quat(b)), t); // the shorter way round
        return {q.x, q.y, q.z, q.w};
    }
    const double t2 = t * t, t3 = t2 * t;
    for (size_t i = 0; i < s.width; ++i) {
        const double from = double(a[i]), to = double(b[i]);
        if (s.interpolation == Interpolation::linear) {
            out[i] = from + t * (to - from);
        } else { // the Hermite form of the glTF 2.0 specification, appendix C
            const double leave = span * double(s.out_tangent(before)[i]), arrive = span * double(s.in_tangent(after)[i]);
            out[i] = (2 * t3 - 3 * t2 + 1) * from + (t3 - 2 * t2 + t) * leave + (3 * t2 - 2 * t3) * to + (t3 - t2) * arrive;
        }
    }
    return out;
}

void set(Node& node, const std::string& path, const std::vector<double>& v, const Value& channel)
{
    const size_t expected = path == "rotation" ? 4 : path == "weights" ? v.size() : 3;
    if (v.size() != expected) channel.bad("drives a {}, but its sampler gives {} numbers", printable(path), v.size());
    if (path == "translation")
        node.translation = dvec3(v[0], v[1], v[2]);
    else if (path == "rotation")
        node.rotation = dquat(v[3], v[0], v[1], v[2]);
    else if (path == "scale")
        node.scale = dvec3(v[0], v[1], v[2]);
    else if (path == "weights")
        node.weights.assign(v.begin(), v.end());
    else
        channel.bad("drives the unknown property '{}'", printable(path));
}

void animate_one(Document& document, const Value& animation, std::vector<Node>& nodes, double time)
{
    const Value channels = animation.at("channels"), sampler_values = animation.at("samplers");
    std::map<size_t, Sampler> samplers; // only those in use and sound
    double duration = 0;
    for (size_t i = 0; i < sampler_values.size(); ++i)
        document.recover("its channels are left out", [&] {
            const Sampler& s = samplers.emplace(i, read_sampler(document, sampler_values[i])).first->second;
            duration = std::max(duration, double(s.times.back()));
        });
    if (duration > 0) time -= std::floor(time / duration) * duration;
    for (size_t i = 0; i < channels.size(); ++i)
        document.recover("the channel is left out", [&] {
            const Value target = channels[i].at("target"), reference = target.find("node"), index = channels[i].at("sampler");
            if (!reference) return; // an extension's target
            document.element("nodes", reference);
            Node& node = nodes[reference.integer()];
            if (index.integer() >= sampler_values.size())
                index.bad("refers to sampler {}, but the animation has {}", index.integer(), sampler_values.size());
            const auto found = samplers.find(index.integer());
            if (found == samplers.end()) return; // warned of above
            const std::string& path = target.at("path").text();
            if (node.has_matrix && path != "weights") target.bad("drives nodes[{}], which has a fixed matrix", reference.integer());
            if (path == "rotation" && found->second.width != 4) channels[i].bad("drives a rotation without four numbers a key");
            set(node, path, sample(found->second, time, path == "rotation"), channels[i]);
        });
}

} // namespace

void animate(Document& document, std::vector<Node>& nodes, double time)
{
    const size_t count = document.count("animations");
    for (size_t i = 0; i < count; ++i) animate_one(document, document.element("animations", i), nodes, time);
}

double animation_seconds(Document& document)
{
    double longest = 0;
    for (size_t i = 0; i < document.count("animations"); ++i) {
        const Value samplers = document.element("animations", i).find("samplers");
        for (size_t k = 0; k < samplers.size(); ++k)
            document.recover(
                "it is left out", [&] { longest = std::max(longest, double(read_times(document, samplers[k].at("input")).back())); });
    }
    return longest;
}

} // namespace gnomon::scene::gltf
