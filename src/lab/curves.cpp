// SPDX-License-Identifier: Apache-2.0
#include "lab/curves.h"

#include "base/file.h"
#include "lab/plot.h"

#include <fmt/format.h>

#include <cmath>

namespace gnomon::lab {

namespace fs = std::filesystem;

namespace {

std::string quoted(const std::string& name) { return name.find(',') == std::string::npos ? name : "\"" + name + "\""; }

std::string draw(const Curves& c, const fs::path& file)
{
    PlotSpec spec;
    spec.file = c.id, spec.title = c.title, spec.x_label = c.x_label, spec.y_label = c.y_label;
    spec.log_x = c.log_x, spec.log_y = c.log_y;
    std::vector<PlotSeries> series;
    for (const Curve& curve : c.curves) {
        PlotSeries s{curve.name, curve.color, curve.dash, true, {}, false};
        for (size_t i = 0; i < c.x.size(); ++i)
            if (std::isfinite(curve.y[i])) s.points.push_back({"", c.x[i], curve.y[i], 0.0});
        series.push_back(s);
    }
    return draw_series(spec, series, file);
}

} // namespace

std::string curves_csv(const Curves& c)
{
    std::string out = quoted(c.x_label);
    for (const Curve& curve : c.curves) out += "," + quoted(curve.name);
    out += "\n";
    for (size_t i = 0; i < c.x.size(); ++i) {
        out += fmt::format("{:.6g}", c.x[i]);
        for (const Curve& curve : c.curves) out += std::isfinite(curve.y[i]) ? fmt::format(",{:.6g}", curve.y[i]) : ",";
        out += "\n";
    }
    return out;
}

std::vector<fs::path> write_curves(const std::vector<Curves>& all, const fs::path& folder, std::vector<std::string>& notes)
{
    std::vector<fs::path> files;
    std::string page = "# Perspective error of light maps\n\nComputed by `gnomon curves` from the equations in "
                       "[error analysis](../../docs/error-analysis.md).\n";
    fs::create_directories(folder);
    for (const Curves& c : all) {
        files.push_back(folder / (c.id + ".csv"));
        base::write_text(files.back(), curves_csv(c));
        const fs::path picture = folder / (c.id + ".svg");
        if (const std::string why = draw(c, picture); why.empty())
            files.push_back(picture);
        else
            notes.push_back(why);
        page += fmt::format("\n## {}\n\n![{}]({}.svg)\n\n{} ([numbers]({}.csv))\n", c.title, c.title, c.id, c.text, c.id);
    }
    files.push_back(folder / "README.md");
    base::write_text(files.back(), page);
    return files;
}

} // namespace gnomon::lab
