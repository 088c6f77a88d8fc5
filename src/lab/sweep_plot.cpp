// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"
#include "lab/plot_labels.h"
#include "lab/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fcntl.h>
#include <set>
#include <spawn.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

extern char** environ;

namespace gnomon::lab {

namespace fs = std::filesystem;

namespace {

std::optional<double> as_number(const std::string& text)
{
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return {};
    return value;
}

std::vector<PlotPoint> points_of(const PlotSpec& plot, const std::vector<Row>& rows, bool measured)
{
    std::vector<PlotPoint> out;
    if (measured && plot.points.empty()) {
        for (const Row& row : rows)
            if (row.number(plot.x) && row.number(plot.y)) out.push_back({"", *row.number(plot.x), *row.number(plot.y), 0});
        return out;
    }
    for (const RowGroup& at : grouped(rows, measured ? plot.points : std::vector<std::string>{plot.x}, {})) {
        const std::optional<double> x = measured ? at.mean(plot.x) : as_number(at.key.front()), y = at.mean(plot.y);
        if (!y || (measured && !x)) continue;
        const double deviation = plot.y == "ms" && at.rows.size() == 1 ? at.rows.front().number("ms_deviation").value_or(0) : 0;
        out.push_back({measured ? "" : at.key.front(), x.value_or(NAN), *y, deviation});
    }
    // a line goes from left to right, in whatever order the runs came
    if (!measured && std::none_of(out.begin(), out.end(), [](const PlotPoint& p) { return std::isnan(p.x); }))
        std::stable_sort(out.begin(), out.end(), [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
    return out;
}

/// One series for each combination of the series' columns; runs that share x too are averaged.
std::vector<PlotSeries> collect(const PlotSpec& plot, const std::vector<Row>& rows)
{
    const bool measured = is_number_column(plot.x);
    std::vector<PlotSeries> out;
    std::map<std::string, size_t> colors, dashes;
    std::map<std::pair<std::string, std::set<const void*>>, size_t> drawn;
    for (const RowGroup& group : grouped(rows, plot.series, plot.where)) {
        // a technique that one of the axes does not concern has the same runs at each of its values: one series, named without it
        std::set<const void*> lines;
        for (const Row& row : group.rows) lines.insert(row.line);
        if (const auto [same, fresh] = drawn.try_emplace({group.key.front(), lines}, out.size()); !fresh) {
            out[same->second].name = group.key.front();
            continue;
        }
        const std::string rest = fmt::format("{}", fmt::join(group.key.begin() + 1, group.key.end(), ", "));
        out.push_back({fmt::format("{}", fmt::join(group.key, ", ")), colors.try_emplace(group.key.front(), colors.size()).first->second,
            dashes.try_emplace(rest, dashes.size()).first->second, !measured || !plot.points.empty(),
            points_of(plot, group.rows, measured)});
    }
    return out;
}

/// Colours that stay apart for the colour-blind (Okabe, Ito 2008).
constexpr const char* colors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#444444", "#8c6d1f"};

/// The texts of x in their order, where they are words.
std::vector<std::string> labels_of(const std::vector<PlotSeries>& series)
{
    std::vector<std::string> out;
    for (const PlotSeries& s : series)
        for (const PlotPoint& p : s.points)
            if (std::find(out.begin(), out.end(), p.label) == out.end()) out.push_back(p.label);
    return out;
}

/// Tics at the values of an axis that has few of them, and nothing between.
std::string number_axis(const PlotSpec& plot, const std::vector<PlotSeries>& series)
{
    std::set<double> xs;
    for (const PlotSeries& s : series)
        for (const PlotPoint& p : s.points)
            if (!p.label.empty()) xs.insert(p.x);
    if (xs.empty() || xs.size() > 12) return "";
    const double low = *xs.begin(), high = *xs.rbegin(), pad = low == high ? 1 : 0.05 * (high - low);
    const double factor = low == high ? 2 : std::pow(high / low, 0.05);
    return fmt::format("set xtics ({})\nset xrange [{}:{}]\n", fmt::join(xs, ", "), plot.log_x ? low / factor : low - pad,
        plot.log_x ? high * factor : high + pad);
}

std::string style(const PlotSeries& s, bool words)
{
    const std::string color = fmt::format("lc '{}'", colors[s.color % std::size(colors)]);
    const size_t dash = s.dash + s.color / std::size(colors); // colours that come again are dashed
    if (words)
        return fmt::format("using 1:2 with boxes fs solid {:.2f} border lc '#333333' {}", std::max(0.25, 0.9 - 0.25 * double(dash)), color);
    constexpr int marks[] = {7, 5, 9, 13, 11, 6, 4, 8, 12, 10};
    const std::string mark = fmt::format("pt {} ps 0.7 {}", marks[dash % std::size(marks)], color);
    if (!s.joined) return "using 1:2 with points " + mark;
    if (!s.marked) return fmt::format("using 1:2 with lines lw 2 dt {} {}", 1 + dash % 5, color);
    const bool bars = std::any_of(s.points.begin(), s.points.end(), [](const PlotPoint& p) { return p.deviation > 0; });
    return fmt::format("{} lw 2 dt {} {}", bars ? "using 1:2:3 with yerrorlines" : "using 1:2 with linespoints", 1 + dash % 5, mark);
}

std::string script(const PlotSpec& plot, const std::vector<PlotSeries>& series, bool words)
{
    // names of 40 letters beside the plot leave it a tenth of its width
    const bool below = std::any_of(series.begin(), series.end(), [](const PlotSeries& s) { return s.name.size() > 40; });
    std::string out
        = fmt::format("set terminal svg size 800,{} dynamic noenhanced background '#ffffff' font 'sans-serif,14'\nset output {}\n"
                      "set title {}\nset xlabel {}\nset ylabel {}\nset grid lc '#cccccc'\nset key outside {} reverse Left\n"
                      "set errorbars 0.7\nset format y '%g'\nset tics nomirror\nset border 3\n",
            below ? 500 + 20 * series.size() : 500, plot_text(plot.file + ".svg"), plot_text(plot.title), plot_text(plot.x_label),
            plot_text(plot.y_label), below ? "below left vertical maxcols 1" : "right top");
    if (plot.log_y) out += "set logscale y\n";
    if (plot.log_x && !words) out += "set logscale x\n";
    const std::vector<std::string> labels = words ? labels_of(series) : std::vector<std::string>();
    const double width = 0.8 / double(series.size());
    if (words) {
        // a dozen names overlap at 20 degrees where one of them has more than 10 letters
        const bool steep
            = labels.size() > 8 && std::any_of(labels.begin(), labels.end(), [](const std::string& l) { return l.size() > 10; });
        out += fmt::format("set xtics rotate by {} (", steep ? -40 : -20);
        for (size_t i = 0; i < labels.size(); ++i) out += fmt::format("{}{} {}", i ? ", " : "", plot_text(labels[i]), i);
        out += fmt::format(")\nset xrange [-0.6:{}]\nset boxwidth {}\n", double(labels.size()) - 0.4, width);
        if (!plot.log_y) out += "set yrange [0:*]\n";
    } else
        out += number_axis(plot, series);
    const bool noted = std::any_of(series.begin(), series.end(), [](const PlotSeries& s) {
        return std::any_of(s.points.begin(), s.points.end(), [](const PlotPoint& p) { return !p.note.empty(); });
    });
    if (noted) out += label_script(plot, series);
    if (plot.y_floor > 0) out += fmt::format("set encoding utf8\nset ytics add ('≈ 0' {})\n", plot.y_floor);
    for (size_t i = 0; i < series.size(); ++i) {
        out += fmt::format("$d{} << EOD\n", i);
        for (const PlotPoint& p : series[i].points) {
            const double group = double(std::find(labels.begin(), labels.end(), p.label) - labels.begin());
            out += fmt::format("{} {} {} {}\n", words ? group + (double(i) + 0.5) * width - 0.4 : p.x, p.y, p.deviation,
                p.note.empty() ? "" : plot_text(p.note));
        }
        out += "EOD\n";
    }
    for (size_t i = 0; i < series.size(); ++i)
        out += fmt::format("{} $d{} {} title {}", i ? "," : "plot", i, style(series[i], words), plot_text(series[i].name));
    for (size_t i = 0; i < series.size() && noted; ++i) // said when the pointer rests on a mark
        out += fmt::format(",$d{} using 1:2:4 with labels hypertext point pt 7 ps 0.7 lc rgb '#ff000000' notitle", i);
    return out + "\n";
}

/// Runs gnuplot on a script in a folder; its complaints go to the file `log`. The exit status, or -1 with errno.
int gnuplot(const fs::path& script_file, const fs::path& log)
{
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 2, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    std::string program = "gnuplot", argument = script_file.string();
    char* arguments[] = {program.data(), argument.data(), nullptr};
    pid_t child = 0;
    const int error = posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error) return errno = error, -1;
    int status = 0;
    while (::waitpid(child, &status, 0) < 0)
        if (errno != EINTR) return -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 255;
}

} // namespace

std::string draw_plot(const PlotSpec& plot, const std::vector<Row>& rows, const fs::path& file)
{
    return draw_series(plot, collect(plot, rows), file);
}

std::string draw_series(const PlotSpec& plot, std::vector<PlotSeries> series, const fs::path& file)
{
    bool words = false;
    for (const PlotSeries& s : series)
        for (const PlotPoint& p : s.points) words = words || std::isnan(p.x);
    // nothing can be drawn at 0 of a logarithmic axis
    for (PlotSeries& s : series) {
        for (PlotPoint& p : s.points) p.y = plot.y_floor > 0 ? std::max(p.y, plot.y_floor) : p.y;
        std::erase_if(s.points, [&](const PlotPoint& p) { return (plot.log_y && !(p.y > 0)) || (plot.log_x && !words && !(p.x > 0)); });
    }
    std::erase_if(series, [](const PlotSeries& s) { return s.points.empty(); });
    if (series.empty()) return fmt::format("the plot '{}' is not made: no finished run has a {} that can be drawn", plot.title, plot.y);
    const fs::path name = fs::absolute(file);
    fs::path script_file = name, log = name;
    script_file.replace_extension(".gnuplot"), log.replace_extension(".log");
    base::write_text(script_file, fmt::format("cd {}\n", plot_text(name.parent_path().string())) + script(plot, series, words));
    const int status = gnuplot(script_file, log);
    std::error_code ignored;
    std::string why;
    if (status < 0 || status == 127)
        why = "plots are not made: gnuplot cannot be started; install it (Debian: gnuplot-nox) and run the same command again";
    else if (status != 0)
        why = fmt::format("the plot '{}' is not made: gnuplot gave up, as {} says", plot.title, log.string());
    if (status != 0 && why.find(log.string()) != std::string::npos) return why;
    fs::remove(script_file, ignored), fs::remove(log, ignored);
    return why;
}

} // namespace gnomon::lab
