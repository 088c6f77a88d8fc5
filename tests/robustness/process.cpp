// SPDX-License-Identifier: Apache-2.0
#include "process.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <optional>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gnomon::tests {

namespace fs = std::filesystem;

namespace {

/// In the child: only calls that are safe after a fork.
[[noreturn]] void start(char** arguments, const char* folder, const char* out, const char* err, uint64_t memory)
{
    const int to_out = ::open(out, O_WRONLY | O_CREAT | O_TRUNC, 0666), to_err = ::open(err, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (::dup2(to_out, 1) < 0 || ::dup2(to_err, 2) < 0 || ::chdir(folder) != 0) ::_exit(126);
    if (memory) {
        const rlimit limit{memory, memory};
        ::setrlimit(RLIMIT_AS, &limit);
    }
    ::signal(SIGINT, SIG_DFL); // a shell's background jobs inherit that it is ignored
    ::execv(GNOMON_PROGRAM, arguments);
    ::_exit(127);
}

/// Sets variables for the time of a fork.
class Environment {
public:
    explicit Environment(const std::map<std::string, std::string>& values)
    {
        for (const auto& [name, value] : values) {
            const char* old = std::getenv(name.c_str());
            old_.emplace_back(name, old ? std::optional<std::string>(old) : std::nullopt);
            ::setenv(name.c_str(), value.c_str(), 1);
        }
    }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;
    ~Environment()
    {
        for (const auto& [name, value] : old_)
            if (value)
                ::setenv(name.c_str(), value->c_str(), 1);
            else
                ::unsetenv(name.c_str());
    }

private:
    std::vector<std::pair<std::string, std::optional<std::string>>> old_;
};

} // namespace

Finished run_gnomon(const std::vector<std::string>& arguments, const fs::path& folder, const RunOptions& options)
{
    std::vector<std::string> words = {"gnomon"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& w : words) pointers.push_back(w.data());
    pointers.push_back(nullptr);
    const std::string out = folder / ".out", err = folder / ".err", where = folder;
    std::map<std::string, std::string> variables = {{"GNOMON_CACHE", folder / ".cache"}};
    for (const auto& [name, value] : options.environment) variables[name] = value;

    const auto begin = std::chrono::steady_clock::now();
    const auto elapsed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
    pid_t child = 0;
    {
        const Environment environment(variables);
        child = ::fork();
        if (child == 0) start(pointers.data(), where.c_str(), out.c_str(), err.c_str(), options.memory);
    }
    Finished f;
    int status = 0;
    rusage usage{};
    while (::wait4(child, &status, WNOHANG, &usage) == 0) {
        f.timed_out = elapsed() > options.seconds;
        if (f.timed_out || (options.kill_when && options.kill_when())) {
            ::kill(child, f.timed_out ? SIGKILL : options.kill_signal);
            ::wait4(child, &status, 0, &usage);
            break;
        }
        ::usleep(1000);
    }
    f.seconds = elapsed();
    f.peak_memory = uint64_t(usage.ru_maxrss) * 1024;
    if (WIFEXITED(status))
        f.code = WEXITSTATUS(status);
    else
        f.signal = WTERMSIG(status);
    f.out = read_whole(out), f.err = read_whole(err);
    return f;
}

Scratch::Scratch()
{
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test->test_suite_name()) + "." + test->name();
    std::replace(name.begin(), name.end(), '/', '_');
    folder_ = fs::path(testing::TempDir()) / ("gnomon-" + std::to_string(::getpid()) + "-" + name);
    fs::create_directories(folder_);
}

Scratch::~Scratch()
{
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

std::string read_whole(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void expect_sentence(const Finished& f, int code, const std::vector<std::string>& words)
{
    EXPECT_FALSE(f.timed_out) << "after " << f.seconds << " s";
    EXPECT_EQ(f.signal, 0);
    EXPECT_EQ(f.code, code) << f.err;
    EXPECT_EQ(f.out, "");
    EXPECT_EQ(f.err.rfind("gnomon: ", 0), 0u) << f.err;
    EXPECT_EQ(std::count(f.err.begin(), f.err.end(), '\n'), 1) << f.err;
    for (const std::string& word : words) EXPECT_NE(f.err.find(word), std::string::npos) << "lacks '" << word << "': " << f.err;
}

} // namespace gnomon::tests
