// SPDX-License-Identifier: Apache-2.0
#include "lab/plot_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

namespace gnomon::lab {

namespace {

constexpr double line_height = 14, mark_radius = 5; ///< pixels
constexpr double left = 100, right = 980, bottom = 550, top = 40, picture_width = 1000, picture_height = 690;

/// Pixels that a text takes in common sans serif fonts of 11 points, rather too many.
double text_width(const std::string& text)
{
    double width = 0;
    for (const char c : text)
        width += std::string_view("mwMW").find(c) != std::string_view::npos  ? 10.8
            : std::string_view("fijlt.:,").find(c) != std::string_view::npos ? 4.6
                                                                             : 7.0;
    return width;
}

struct Box {
    double x0, y0, x1, y1;
};

bool overlap(const Box& a, const Box& b) { return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1; }

/// Does the segment from (x, y) to (u, v) meet the box? Sampled: boxes are far larger than the step.
bool crosses(double x, double y, double u, double v, const Box& box)
{
    const int steps = 1 + int(std::hypot(u - x, v - y) / 3);
    for (int i = 0; i <= steps; ++i) {
        const double t = double(i) / steps, px = x + t * (u - x), py = y + t * (v - y);
        if (px > box.x0 && px < box.x1 && py > box.y0 && py < box.y1) return true;
    }
    return false;
}

/// The text's box whose nearest point lies `distance` from the mark in a direction.
Box candidate(const PlotMark& mark, double distance, double angle)
{
    const double w = text_width(mark.text), c = std::cos(angle), s = std::sin(angle);
    const double x = mark.x + distance * c - (std::abs(c) < 0.3 ? w / 2 : c < 0 ? w : 0), y = mark.y + distance * s;
    return {x, y - line_height / 2, x + w, y + line_height / 2};
}

struct Axis {
    double low, high;
    bool log;

    double at(double v) const { return log ? (std::log(v) - std::log(low)) / (std::log(high) - std::log(low)) : (v - low) / (high - low); }
};

/// Room of some per cent on either side.
Axis axis(double low, double high, bool log, double before, double after)
{
    if (log) {
        const double span = std::max(high / low, 2.0);
        return {low / std::pow(span, before), low * std::pow(span, 1 + after), true};
    }
    const double span = high > low ? high - low : 1.0;
    return {low - before * span, low + (1 + after) * span, false};
}

/// 1, 2 and 5 times the powers of ten: gnuplot's own leave a range of less than a decade with one tic or none.
std::string log_tics(const Axis& axis)
{
    std::vector<std::string> out;
    for (int k = int(std::floor(std::log10(axis.low))); k <= int(std::log10(axis.high)) + 1; ++k)
        for (const int digit : {1, 2, 5}) {
            const double v = digit * std::pow(10.0, k);
            if (v >= axis.low && v <= axis.high) out.push_back(fmt::format("{:.3g}", v));
        }
    return fmt::format("set xtics ({})\n", fmt::join(out, ", "));
}

} // namespace

std::string plot_text(const std::string& in)
{
    std::string out = "\"";
    for (const char c : in) {
        if (c == '"' || c == '\\') out += '\\';
        out += c == '\n' ? ' ' : c;
    }
    return out + "\"";
}

std::vector<std::optional<LabelPlace>> place_labels(
    const std::vector<PlotMark>& marks, const std::vector<PlotLine>& lines, double width, double height)
{
    constexpr double near = mark_radius + 3, reach = 240;
    constexpr int directions = 24;
    std::vector<Box> dots, texts;
    for (const PlotMark& m : marks) dots.push_back({m.x - mark_radius, m.y - mark_radius, m.x + mark_radius, m.y + mark_radius});
    const auto clear = [&](const PlotMark& mark, const Box& box, double to_x, double to_y, bool strict) {
        if (box.x0 < 0 || box.y0 < 0 || box.x1 > width || box.y1 > height) return false;
        const auto leader_meets = [&](const Box& other) { return crosses(mark.x, mark.y, to_x, to_y, other); };
        const auto own = [&](const Box& dot) { return mark.x > dot.x0 && mark.x < dot.x1 && mark.y > dot.y0 && mark.y < dot.y1; };
        return std::none_of(lines.begin(), lines.end(), [&](const PlotLine& l) { return crosses(l.x0, l.y0, l.x1, l.y1, box); })
            && std::none_of(texts.begin(), texts.end(), [&](const Box& other) { return overlap(box, other) || leader_meets(other); })
            && std::none_of(
                dots.begin(), dots.end(), [&](const Box& dot) { return overlap(box, dot) || (strict && !own(dot) && leader_meets(dot)); });
    };
    std::vector<std::optional<LabelPlace>> out(marks.size());
    const auto place = [&](const PlotMark& mark, bool strict) -> std::optional<LabelPlace> {
        for (double distance = near; distance < reach; distance += 6)
            for (int i = 0; i < directions; ++i) {
                // first to the right, then the steeper ones by turns, the left last
                const double angle = std::numbers::pi * 2 * ((i + 1) / 2 * (i % 2 ? 1 : -1)) / directions;
                const double to_x = mark.x + distance * std::cos(angle), to_y = mark.y + distance * std::sin(angle);
                const Box box = candidate(mark, distance, angle);
                if (!clear(mark, box, to_x, to_y, strict)) continue;
                texts.push_back(box);
                return LabelPlace{box.x0, to_y, distance > near};
            }
        return std::nullopt;
    };
    // a line that leads past other marks is worse than one that does not, and better than no text
    for (const bool strict : {true, false})
        for (size_t i = 0; i < marks.size(); ++i)
            if (!out[i]) out[i] = place(marks[i], strict);
    return out;
}

std::string label_script(const PlotSpec& plot, const std::vector<PlotSeries>& series)
{
    double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
    for (const PlotSeries& s : series)
        for (const PlotPoint& p : s.points) x0 = std::min(x0, p.x), x1 = std::max(x1, p.x), y0 = std::min(y0, p.y), y1 = std::max(y1, p.y);
    const Axis x = axis(x0, x1, plot.log_x, 0.06, 0.2), y = axis(y0, y1, plot.log_y, 0.06, 0.08);
    std::string out
        = fmt::format("set terminal svg size {},{} dynamic noenhanced background '#ffffff' font 'sans-serif,14'\n"
                      "set lmargin at screen {}\nset rmargin at screen {}\nset bmargin at screen {}\nset tmargin at screen {}\n"
                      "set key at screen 0.5,0.015 center bottom horizontal reverse Left\nset xrange [{}:{}]\nset yrange [{}:{}]\n",
            picture_width, picture_height, left / picture_width, right / picture_width, 1 - bottom / picture_height,
            1 - top / picture_height, x.low, x.high, y.low, y.high);
    constexpr double width = right - left, height = bottom - top;
    if (plot.log_x && x.high / x.low < 1000) out += log_tics(x);
    std::vector<PlotMark> marks;
    for (const PlotSeries& s : series)
        for (const PlotPoint& p : s.points)
            if (!p.note.empty()) marks.push_back({width * x.at(p.x), height * y.at(p.y), p.note});
    std::vector<PlotLine> lines;
    for (const PlotSeries& s : series)
        for (size_t i = 1; s.joined && i < s.points.size(); ++i)
            lines.push_back({width * x.at(s.points[i - 1].x), height * y.at(s.points[i - 1].y), width * x.at(s.points[i].x),
                height * y.at(s.points[i].y)});
    // from the left: the fast ones, whose neighbours are few, keep the places beside them
    std::stable_sort(marks.begin(), marks.end(), [](const PlotMark& a, const PlotMark& b) { return a.x < b.x; });
    const std::vector<std::optional<LabelPlace>> places = place_labels(marks, lines, width, height);
    for (size_t i = 0; i < marks.size(); ++i) {
        if (!places[i]) continue;
        const double end = places[i]->x + text_width(marks[i].text);
        out += fmt::format("set label {} at graph {:.4f},{:.4f} left font ',11' tc '#333333'\n", plot_text(marks[i].text),
            places[i]->x / width, places[i]->y / height);
        if (places[i]->line)
            out += fmt::format("set arrow from graph {:.4f},{:.4f} to graph {:.4f},{:.4f} nohead lc '#999999' lw 0.6\n", marks[i].x / width,
                marks[i].y / height, std::clamp(marks[i].x, places[i]->x, end) / width,
                (places[i]->y + std::clamp(marks[i].y - places[i]->y, -line_height / 2, line_height / 2)) / height);
    }
    return out;
}

} // namespace gnomon::lab
