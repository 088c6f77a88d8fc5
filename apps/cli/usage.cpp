// SPDX-License-Identifier: Apache-2.0
#include "usage.h"

#include "base/names.h"

#include <algorithm>

namespace gnomon::cli {

namespace {

std::vector<std::string> option_names(const CLI::App& app)
{
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

std::vector<std::string> subcommand_names(const CLI::App& app)
{
    std::vector<std::string> names;
    for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) names.push_back(sub->get_name());
    return names;
}

bool is_option(const std::string& word) { return word.size() > 1 && word[0] == '-'; }

} // namespace

void refuse_words(const CLI::App& app, const std::vector<std::string>& words, const std::string& hint)
{
    const auto option = std::find_if(words.begin(), words.end(), is_option);
    if (option != words.end())
        throw UsageError(base::unknown_name("option", option->substr(0, option->find('=')), option_names(app)) + hint);
    if (const std::vector<std::string> names = subcommand_names(app); !names.empty())
        throw UsageError(base::unknown_name("subcommand", words.front(), names));
    throw UsageError(fmt::format("what is '{}' for? An option's name is missing before it", words.front()));
}

void refuse(const CLI::App& app, const CLI::ParseError& error)
{
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    const CLI::App& at = chosen.empty() ? app : *chosen.front();
    // A wrong word says more than the option that is missing because of it.
    if (const std::vector<std::string> words = at.remaining(); !words.empty() && !at.get_allow_extras()) refuse_words(at, words);
    if (chosen.empty())
        throw UsageError(fmt::format("name a subcommand: {}; `gnomon --help` explains them", fmt::join(subcommand_names(app), ", ")));
    std::string what = error.what();
    std::replace(what.begin(), what.end(), '\n', ' ');
    throw UsageError(fmt::format("{}; `gnomon {} --help` explains", what, at.get_name()));
}

} // namespace gnomon::cli
