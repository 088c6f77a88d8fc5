// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>

namespace host {

const char* const usage = R"(usage: host_engine [options]

  --headless              no window; draws --frames frames (default 60) and ends
  --frames N              ends after N frames
  --technique A,B,..      shadows, changed every --hold frames (default 30) or by the space bar: shadow_map,shadow_volumes,pcss
  --settings "A=B C=D"    parameters of the techniques
  --light sun|lamp        (sun)
  --size WxH              (960x540)
  --resize-every N        another size every N frames; the last frame has the first size
  --output FILE.ppm       the last frame
  --validation            under Vulkan's validation layer with synchronisation validation; a message fails the run
  --shuffle SEED          everything is destroyed in an order of chance

what engines differ in:
  --depth reversed|forward|forward24      32-bit float with 1 nearest; 32-bit float, and 24 bits, with 0 nearest
  --samples 1|4                           a pixel
  --normals float|bytes|octahedral|none   what is handed to Gnomon
  --up y|z   --hand right|left   --front counter_clockwise|clockwise   --clip y_down|y_up
  --unit METRES                           per unit (1)
  --vertices float|packed                 32 bytes a vertex with float positions, or 24 with 16-bit ones
)";

Mat3 Convention::axes() const
{
    const Mat3 y_up_axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, left_handed ? -1.0f : 1.0f}};
    const Mat3 z_up_axes{Vec3{1, 0, 0}, Vec3{0, 0, 1}, Vec3{0, left_handed ? 1.0f : -1.0f, 0}};
    return up == 2 ? z_up_axes : y_up_axes;
}

namespace {

uint32_t number(const std::string& word, uint32_t least, uint32_t most)
{
    size_t end = 0;
    unsigned long value = 0;
    try {
        value = std::stoul(word, &end);
    } catch (const std::logic_error&) { // no digits, or too many: the range below says so
        end = 0;
    }
    if (end == 0 || end != word.size() || value < least || value > most)
        throw std::runtime_error("'" + word + "' is no number from " + std::to_string(least) + " to " + std::to_string(most));
    return uint32_t(value);
}

template <class T> T choose(const std::string& word, const std::map<std::string, T>& all)
{
    const auto found = all.find(word);
    if (found != all.end()) return found->second;
    std::string known;
    for (const auto& [name, value] : all) known += " " + name;
    throw std::runtime_error("'" + word + "' is none of:" + known);
}

std::vector<std::string> split(const std::string& list, char by)
{
    std::vector<std::string> parts;
    std::istringstream in(list);
    for (std::string part; std::getline(in, part, by);) parts.push_back(part);
    return parts;
}

void set_size(Options& o, const std::string& word)
{
    const auto parts = split(word, 'x');
    if (parts.size() != 2) throw std::runtime_error("'" + word + "' is no size; one is 960x540");
    o.width = number(parts[0], 1, 16384);
    o.height = number(parts[1], 1, 16384);
}

void set_depth(Convention& c, const std::string& word)
{
    c.reversed_depth = choose<bool>(word, {{"reversed", true}, {"forward", false}, {"forward24", false}});
    c.depth_format = word == "forward24" ? VK_FORMAT_X8_D24_UNORM_PACK32 : VK_FORMAT_D32_SFLOAT;
}

void set_unit(Convention& c, const std::string& word)
{
    c.metres = std::strtof(word.c_str(), nullptr);
    if (!(c.metres > 1e-4f && c.metres < 1e4f)) throw std::runtime_error("'" + word + "' is no length of a unit in metres");
}

} // namespace

Options parse(int count, char** words)
{
    Options o;
    Convention& c = o.convention;
    const std::map<std::string, std::function<void()>> flags{
        {"--headless", [&] { o.headless = true; }}, {"--validation", [&] { o.validation = true; }}, {"--help", [&] { o.help = true; }}};
    using Word = const std::string&;
    const std::map<std::string, std::function<void(Word)>> values{{"--frames", [&](Word w) { o.frames = number(w, 1, 1000000); }},
        {"--technique", [&](Word w) { o.techniques = split(w, ','); }}, {"--settings", [&](Word w) { o.settings = w; }},
        {"--hold", [&](Word w) { o.hold = number(w, 1, 1000000); }},
        {"--light",
            [&](Word w) {
                o.lamp = choose<bool>(w, {{"sun", false}, {"lamp", true}});
            }},
        {"--size", [&](Word w) { set_size(o, w); }}, {"--resize-every", [&](Word w) { o.resize_every = number(w, 1, 1000000); }},
        {"--output", [&](Word w) { o.output = w; }}, {"--shuffle", [&](Word w) { o.shuffle = number(w, 1, ~0u); }},
        {"--depth", [&](Word w) { set_depth(c, w); }},
        {"--samples",
            [&](Word w) {
                c.samples
                    = choose(w, std::map<std::string, VkSampleCountFlagBits>{{"1", VK_SAMPLE_COUNT_1_BIT}, {"4", VK_SAMPLE_COUNT_4_BIT}});
            }},
        {"--normals",
            [&](Word w) {
                c.normals = choose<Normals>(w,
                    {{"float", Normals::floats}, {"bytes", Normals::bytes}, {"octahedral", Normals::octahedral}, {"none", Normals::none}});
            }},
        {"--up",
            [&](Word w) {
                c.up = choose<uint32_t>(w, {{"y", 1u}, {"z", 2u}});
            }},
        {"--hand",
            [&](Word w) {
                c.left_handed = choose<bool>(w, {{"right", false}, {"left", true}});
            }},
        {"--front",
            [&](Word w) {
                c.clockwise = choose<bool>(w, {{"counter_clockwise", false}, {"clockwise", true}});
            }},
        {"--clip",
            [&](Word w) {
                c.y_up = choose<bool>(w, {{"y_down", false}, {"y_up", true}});
            }},
        {"--unit", [&](Word w) { set_unit(c, w); }}, {"--vertices", [&](Word w) {
                                                          c.packed_vertices = choose<bool>(w, {{"float", false}, {"packed", true}});
                                                      }}};
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        if (const auto flag = flags.find(word); flag != flags.end()) {
            flag->second();
        } else if (const auto value = values.find(word); value != values.end()) {
            if (++i == count) throw std::runtime_error(word + " wants a word after it");
            value->second(words[i]);
        } else {
            throw std::runtime_error("unknown option " + word + "; --help lists them");
        }
    }
    if (o.techniques.empty()) throw std::runtime_error("--technique names none");
    if (o.headless && o.frames == 0) o.frames = 60;
    return o;
}

} // namespace host
