// SPDX-License-Identifier: Apache-2.0
#include "base/file.h"
#include "tests/source_root.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

// Dependencies go one way only (docs/architecture.md), and committed text is clean. Read from the sources, since a wrong include
// compiles: all folders share one include path.
namespace {

namespace fs = std::filesystem;
using gnomon::tests::source_root;

/// What a folder's files may include besides the folder itself.
const std::map<std::string, std::set<std::string>> allowed_folders = {
    {"src/base", {}}, {"src/gpu", {"src/base"}}, {"src/scene", {"src/base"}}, {"src/metrics", {"src/base"}},
    {"src/truth", {"src/scene", "src/base"}}, {"src/shadow", {"src/gpu", "src/scene", "src/base", "shaders"}},
    {"src/host", {"include/gnomon", "src/shadow", "src/gpu", "src/scene", "src/base", "shaders"}},
    {"src/lab", {"src/shadow", "src/truth", "src/metrics", "src/gpu", "src/scene", "src/base", "shaders"}},
    {"techniques", {"src/shadow"}}, // the registry
    {"techniques/*", {"src/shadow", "src/gpu", "src/scene", "src/base", "shaders"}},
    {"apps/*", {"apps/view", "src/lab", "src/shadow", "src/truth", "src/metrics", "src/gpu", "src/scene", "src/base", "shaders"}},
    {"python", {"src/lab", "src/shadow", "src/truth", "src/metrics", "src/gpu", "src/scene", "src/base"}},
    {"shaders", {"src/scene"}}, // shared.h takes GLM's types from scene/math.h
};

/// The same for a technique's GLSL, which must not reach into the insides of src/shadow.
const std::set<std::string> allowed_in_technique_glsl = {"shaders", "src/shadow/parts"};

/// Packages that only these folders know.
const std::map<std::string, std::set<std::string>> package_users = {
    {"volk.h", {"src/gpu", "src/shadow", "src/host", "src/lab", "techniques/*", "apps/*"}},
    {"vulkan/", {"src/gpu", "include/gnomon"}},
    {"embree3/", {"src/truth"}},
};

/// "src/gpu", "techniques/pcss", "shaders" ...: the folder that rules speak of.
std::string folder_of(const fs::path& file)
{
    const std::string top = file.begin()->string();
    const bool nested = std::distance(file.begin(), file.end()) > 2;
    return top != "shaders" && nested ? top + "/" + std::next(file.begin())->string() : top;
}

/// folder_of as the tables write it: one rule for all techniques, one for all apps.
std::string rule_of(const std::string& folder)
{
    for (const std::string top : {"techniques/", "apps/"})
        if (folder.starts_with(top)) return top + "*";
    return folder;
}

bool is_glsl(const fs::path& file) { return file.extension() == ".glsl"; }

/// The included file, relative to the root: beside the includer, else from the root (-I .), else from src/ (-I src).
fs::path resolve(const fs::path& includer, const std::string& name)
{
    fs::path beside = (includer.parent_path() / name).lexically_normal();
    if (fs::exists(source_root() / beside)) return beside;
    const std::string top = fs::path(name).begin()->string();
    if (top == "shaders" || top == "techniques" || top == "src" || top == "apps" || top == "tests") return name;
    return fs::path("src") / name;
}

bool may_include(const fs::path& includer, const fs::path& target)
{
    const std::string from = folder_of(includer), to = folder_of(target);
    if (from == to || target.extension() == ".inc") return true; // .inc: generated
    if (is_glsl(includer) && from.starts_with("techniques/"))
        return std::ranges::any_of(allowed_in_technique_glsl, [&](const std::string& f) { return target.string().starts_with(f + "/"); });
    const auto rule = allowed_folders.find(rule_of(from));
    return rule != allowed_folders.end() && rule->second.contains(to);
}

/// One sentence for each forbidden include of `text`, the content of `file` (a path relative to the root).
std::vector<std::string> forbidden_includes(const fs::path& file, const std::string& text)
{
    static const std::regex include(R"re((?:^|\n)[ \t]*#[ \t]*include[ \t]*(["<])([^">\n]+)[">])re");
    std::vector<std::string> found;
    for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it) {
        const std::string name = (*it)[2];
        bool allowed = true;
        if ((*it)[1] == "\"")
            allowed = may_include(file, resolve(file, name));
        else
            for (const auto& [package, users] : package_users)
                if (name.starts_with(package)) allowed = allowed && users.contains(rule_of(folder_of(file)));
        if (!allowed) found.push_back(file.string() + " must not include " + name);
    }
    return found;
}

/// Not committed: build folders, results, git's own (a file in a linked worktree).
bool uncommitted(const fs::path& path)
{
    const std::string name = path.filename().string();
    return name == ".git" || name == ".cache" || (fs::is_directory(path) && (name.starts_with("build") || name == "out"));
}

/// All files under `folder` of the source tree, relative to its root, sorted.
std::vector<fs::path> files_under(const fs::path& folder)
{
    std::vector<fs::path> files;
    const fs::path root = source_root();
    if (!fs::exists(root / folder)) return files;
    for (fs::recursive_directory_iterator it(root / folder), end; it != end; ++it) {
        if (uncommitted(it->path()))
            it.disable_recursion_pending();
        else if (it->is_regular_file())
            files.push_back(it->path().lexically_relative(root).lexically_normal());
    }
    std::ranges::sort(files);
    return files;
}

TEST(Includes, GoOneWayOnly)
{
    size_t read = 0;
    for (const char* top : {"src", "techniques", "shaders", "apps", "python"})
        for (const fs::path& file : files_under(top)) {
            if (file.extension() != ".cpp" && file.extension() != ".h" && !is_glsl(file)) continue;
            if (file.string().ends_with("_test.cpp")) continue; // a technique's own test may use truth and metrics
            if (file.string().starts_with("techniques/_")) continue; // the template names a technique that is not there yet
            ++read;
            for (const std::string& sentence : forbidden_includes(file, gnomon::base::read_text(source_root() / file)))
                ADD_FAILURE() << sentence << "; docs/architecture.md has the allowed directions";
        }
    EXPECT_GT(read, 20u) << "no sources found in " << source_root();
}

TEST(Includes, RuleSeesForbiddenOnes)
{
    struct Case {
        const char *file, *text;
    };
    for (const Case& c : std::array<Case, 9>{{
             {"src/base/a.cpp", "#include \"scene/scene.h\"\n"},
             {"src/metrics/a.h", "int x;\n  #  include \"scene/scene.h\"\n"},
             {"src/truth/a.cpp", "#include \"gpu/device.h\"\n"},
             {"src/truth/a.cpp", "#include <volk.h>\n"},
             {"src/lab/a.cpp", "#include <embree3/rtcore.h>\n"},
             {"src/lab/a.cpp", "#include \"techniques/pcss/pcss.shared.h\"\n"},
             {"techniques/pcss/pcss.cpp", "#include \"techniques/vsm/vsm.shared.h\"\n"},
             {"techniques/pcss/pcss.cpp", "#include \"../vsm/vsm.shared.h\"\n"},
             {"techniques/pcss/a.frag.glsl", "#include \"src/shadow/gbuffer.shared.h\"\n"},
         }})
        EXPECT_EQ(forbidden_includes(c.file, c.text).size(), 1u) << c.file << ": " << c.text;
}

TEST(Includes, RuleAllowsTheOthers)
{
    struct Case {
        const char *file, *text;
    };
    for (const Case& c : std::array<Case, 7>{{
             {"src/gpu/a.cpp", "#include \"gpu/device.h\"\n#include <volk.h>\n"},
             {"src/truth/a.cpp", "#include <embree3/rtcore.h>\n#include \"scene/scene.h\"\n"},
             {"src/lab/a.cpp", "#include \"shadow/technique.h\"\n#include \"truth/truth.h\"\n"},
             {"techniques/registry.cpp", "#include \"shadow/technique.h\"\n#include \"techniques.inc\"\n"},
             {"techniques/pcss/pcss.cpp", "#include \"techniques/pcss/pcss.shared.h\"\n#include \"shadow/parts/light_map.h\"\n"},
             {"techniques/pcss/a.frag.glsl", "#include \"shaders/receiver.glsl\"\n#include \"src/shadow/parts/blur.glsl\"\n"},
             {"apps/cli/main.cpp", "#include \"lab/experiment.h\"\n"},
         }})
        EXPECT_TRUE(forbidden_includes(c.file, c.text).empty()) << c.file << ": " << c.text;
}

/// Why `text` may not be committed, or "". The brackets keep the needles from finding themselves.
std::string unclean(const std::string& text)
{
    static const std::regex machine_path("/(w[o]rk|r[o]ot|h[o]me/[a-z]+)/");
    static const std::regex unfinished("\\b(T[O]DO|F[I]XME)\\b");
    std::smatch match;
    if (std::regex_search(text, match, machine_path)) return "the path " + match.str() + " of one machine";
    if (std::regex_search(text, match, unfinished)) return "the word " + match.str();
    return {};
}

TEST(CommittedText, HasNoMachinePathsAndNothingUnfinished)
{
    size_t read = 0;
    for (const fs::path& file : files_under(".")) {
        const std::string text = gnomon::base::read_text(source_root() / file);
        if (text.find('\0') != std::string::npos) continue; // a picture
        ++read;
        EXPECT_EQ(unclean(text), "") << file;
    }
    EXPECT_GT(read, 30u) << "no files found in " << source_root();
}

TEST(CommittedText, RuleSeesThem)
{
    EXPECT_NE(unclean(std::string("see /wo") + "rk/scene.glb"), "");
    EXPECT_NE(unclean(std::string("// TO") + "DO: later"), "");
    EXPECT_EQ(unclean("a framework/with a root/folder, and $root/out"), "");
}

} // namespace
