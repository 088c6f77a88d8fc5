// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/names.h"
#include "lab/experiment_expand.h"
#include "lab/json_keys.h"

#include <algorithm>
#include <cctype>
#include <set>

namespace gnomon::lab {

namespace {

bool holds(const std::vector<std::string>& names, const std::string& name)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

class OutputReader {
public:
    explicit OutputReader(Experiment& out)
        : out_(out)
        , texts_(identity_columns())
    {
        texts_.insert(texts_.end(), out.axes.begin(), out.axes.end());
    }

    void run(const Json& json)
    {
        if (json.contains("metrics")) out_.metrics = numbers(json["metrics"], "metrics");
        const bool filtered = std::any_of(out_.cells.begin(), out_.cells.end(), [](const Cell& c) { return c.reference.has_value(); });
        if (out_.metrics.empty()) {
            out_.metrics = {"wrong_pixels", "mae", "bias"};
            if (filtered) out_.metrics.insert(out_.metrics.end(), {"filter_mae", "filter_leak", "filter_dark"});
        }
        for (const Json& table : json.value("tables", Json::array())) read_table(table);
        if (out_.tables.empty()) out_.tables.push_back({"", varying(), default_columns(), {}, default_columns(), {}});
        std::set<std::string> files;
        for (const Json& plot : json.value("plots", Json::array())) {
            read_plot(plot);
            if (!files.insert(out_.plots.back().file).second)
                base::fail("two plots are both written to {}.svg; give one of them another \"file\"", out_.plots.back().file);
        }
        out_.flip = holds(used_, "flip");
    }

private:
    std::string text(const std::string& name, const char* what) const
    {
        if (!holds(texts_, name)) throw base::Error(base::unknown_name(fmt::format("column of {}", what), name, texts_));
        return name;
    }

    std::string number(const std::string& name, const char* what)
    {
        if (!is_number_column(name)) throw base::Error(base::unknown_name(fmt::format("metric of {}", what), name, number_columns()));
        used_.push_back(name);
        return name;
    }

    std::vector<std::string> strings(const Json& list, const char* what) const
    {
        std::vector<std::string> out;
        const Json all = list.is_array() ? list : Json::array({list});
        for (const Json& entry : all) {
            if (!entry.is_string()) base::fail("{} is a list of names, not {}", what, entry.dump().substr(0, 60));
            out.push_back(entry.get<std::string>());
        }
        if (out.empty()) base::fail("{} names nothing", what);
        return out;
    }
    std::vector<std::string> texts(const Json& list, const char* what) const
    {
        std::vector<std::string> out = strings(list, what);
        for (const std::string& name : out) text(name, what);
        return out;
    }
    std::vector<std::string> numbers(const Json& list, const char* what)
    {
        std::vector<std::string> out = strings(list, what);
        for (const std::string& name : out) number(name, what);
        return out;
    }

    Where where(const Json& json) const
    {
        Where out;
        if (!json.is_object()) base::fail("\"where\" is an object of column: value or [values]");
        for (const auto& [name, values] : json.items()) {
            text(name, "where");
            std::set<std::string> there;
            for (const Cell& c : out_.cells) there.insert(c.columns.at(name));
            const Json all = values.is_array() ? values : Json::array({values});
            for (const Json& value : all) {
                out[name].push_back(scalar_text(value));
                if (!there.count(out[name].back()))
                    throw base::Error(
                        base::unknown_name(name + " in \"where\"", out[name].back(), std::vector<std::string>(there.begin(), there.end())));
            }
        }
        return out;
    }

    /// Columns that differ between cells, the technique at least.
    std::vector<std::string> varying() const
    {
        std::vector<std::string> out;
        for (const std::string& name : texts_) {
            const bool one = std::all_of(out_.cells.begin(), out_.cells.end(),
                [&](const Cell& c) { return c.columns.at(name) == out_.cells.front().columns.at(name); });
            if (!one || name == "technique") out.push_back(name);
        }
        return out;
    }

    std::vector<std::string> default_columns() const
    {
        std::vector<std::string> out = {"ms", "mib"};
        out.insert(out.end(), out_.metrics.begin(), out_.metrics.end());
        return out;
    }

    /// "name" or {"column": "name", "label": "heading"}.
    void read_columns(const Json& json, TableSpec& table)
    {
        const Json all = json.is_array() ? json : Json::array({json});
        for (const Json& entry : all) {
            if (entry.is_object()) known_keys(entry, {"column", "label"}, out_.file);
            const std::string name = strings(entry.is_object() ? entry.value("column", Json()) : entry, "columns").front();
            table.columns.push_back(number(name, "columns"));
            table.labels.push_back(entry.is_object() ? entry.value("label", name) : name);
        }
        if (table.columns.empty()) base::fail("columns names nothing");
    }

    void read_published(const Json& json, TableSpec& table)
    {
        known_keys(json, {"rows", "values"}, out_.file);
        TableSpec::Published row;
        row.texts = strings(json.value("rows", Json::array()), "rows of a published row");
        const Json values = json.value("values", Json::array());
        for (const Json& value : values) {
            if (!value.is_number() && !value.is_null())
                base::fail("the values of a published row are numbers or null, not {}", value.dump().substr(0, 60));
            row.numbers.push_back(value.is_null() ? std::nullopt : std::optional<double>(value.get<double>()));
        }
        if (row.texts.size() != table.rows.size() || row.numbers.size() != table.columns.size())
            base::fail("the published row {} has {} texts and {} values; this table's rows have {} and {}", json.dump().substr(0, 60),
                row.texts.size(), row.numbers.size(), table.rows.size(), table.columns.size());
        table.published.push_back(std::move(row));
    }

    void read_table(const Json& json)
    {
        known_keys(json, {"title", "rows", "columns", "where", "published"}, out_.file);
        TableSpec table;
        table.title = json.value("title", "");
        table.rows = json.contains("rows") ? texts(json["rows"], "rows") : varying();
        read_columns(json.contains("columns") ? json["columns"] : Json(default_columns()), table);
        table.where = where(json.value("where", Json::object()));
        for (const Json& row : json.value("published", Json::array())) read_published(row, table);
        out_.tables.push_back(std::move(table));
    }

    static std::string file_name(const std::string& text)
    {
        std::string out;
        for (const char c : text)
            out += std::isalnum(static_cast<unsigned char>(c)) ? char(std::tolower(static_cast<unsigned char>(c))) : '_';
        return out;
    }

    void read_plot(const Json& json)
    {
        known_keys(json, {"file", "title", "x", "y", "series", "points", "where", "log", "x_label", "y_label"}, out_.file);
        if (!json.contains("x") || !json.contains("y"))
            base::fail("a plot needs \"x\" and \"y\"; this one is {}", json.dump().substr(0, 80));
        PlotSpec plot;
        plot.x = strings(json["x"], "x").front(), plot.y = number(strings(json["y"], "y").front(), "y");
        if (!holds(texts_, plot.x)) number(plot.x, "x");
        plot.series = json.contains("series") ? texts(json["series"], "series") : std::vector<std::string>{"technique"};
        if (json.contains("points")) plot.points = texts(json["points"], "points");
        plot.where = where(json.value("where", Json::object()));
        plot.title = json.value("title", fmt::format("{} over {}", plot.y, plot.x));
        plot.x_label = json.value("x_label", plot.x), plot.y_label = json.value("y_label", plot.y);
        plot.file = file_name(json.value("file", plot.y + "_over_" + plot.x));
        const std::string log = json.value("log", "");
        if (log.find_first_not_of("xy") != std::string::npos) base::fail("\"log\" is \"x\", \"y\" or \"xy\", not \"{}\"", log);
        plot.log_x = log.find('x') != std::string::npos, plot.log_y = log.find('y') != std::string::npos;
        out_.plots.push_back(std::move(plot));
    }

    Experiment& out_;
    std::vector<std::string> texts_, used_;
};

} // namespace

void read_outputs(const Json& json, Experiment& out) { OutputReader(out).run(json); }

} // namespace gnomon::lab
