// SPDX-License-Identifier: MIT
//
// Programs as people run them: processes of their own, which tests signal, kill and start again.
#pragma once

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace selvage::testing {

class ChildProcess {
 public:
  /// What it logs goes to a file.
  ChildProcess(const std::string& program, std::vector<std::string> arguments, std::filesystem::path log)
      : log_(std::move(log)) {
    arguments.insert(arguments.begin(), program);
    int out[2];
    if (::pipe2(out, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    const std::string log_path = log_.string();
    pid_ = ::fork();
    if (pid_ == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // however the test ends
      const int file = ::open(log_path.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
      ::dup2(out[1], STDOUT_FILENO);
      ::dup2(file, STDERR_FILENO);
      ::execv(program.c_str(), argv.data());
      ::_exit(127);
    }
    ::close(out[1]);
    stdout_ = ::fdopen(out[0], "r");
  }
  ~ChildProcess() {
    if (pid_ > 0) end(SIGKILL);
    std::fclose(stdout_);
  }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  void signal(int number) { ::kill(pid_, number); }

  /// Sends the signal, unless 0, and waits; the exit code, or minus the signal that ended it.
  int end(int number) {
    if (number != 0) ::kill(pid_, number);
    int status = 0;
    ::waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  /// Waits until the program catches the signal: before, it would just die of it. Throws if it ends first.
  void wait_until_it_handles(int number) {
    const std::uint64_t bit = std::uint64_t{1} << (number - 1);
    while ((caught_signals() & bit) == 0) std::this_thread::yield();
  }

  std::string log() const {
    std::ostringstream text;
    text << std::ifstream(log_).rdbuf();
    return text.str();
  }

  /// The next line it prints, without its end; empty if there is none any more.
  std::string read_line() {
    char line[256] = {};
    std::string said = std::fgets(line, sizeof line, stdout_) != nullptr ? line : "";
    if (said.ends_with('\n')) said.pop_back();
    return said;
  }

  /// All that it prints, until it ends or closes its output.
  std::string read_all() {
    std::string text;
    for (int c; (c = std::fgetc(stdout_)) != EOF;) text += static_cast<char>(c);
    return text;
  }

 private:
  /// From /proc/PID/status.
  std::uint64_t caught_signals() const {
    const std::string prefix = "SigCgt:\t";
    std::ifstream status("/proc/" + std::to_string(pid_) + "/status");
    for (std::string line; std::getline(status, line);)
      if (line.starts_with(prefix)) return std::stoull(line.substr(prefix.size()), nullptr, 16);
    throw std::runtime_error("the program has ended: " + log());
  }

  const std::filesystem::path log_;
  pid_t pid_ = -1;
  std::FILE* stdout_ = nullptr;
};

/// What a program says on both outputs, and its exit code.
struct ProgramOutput {
  std::string text;
  int code = 0;
};

/// A path as one word of a command line.
inline std::string quoted(const std::string& path) { return "'" + path + "'"; }

inline ProgramOutput run_program(const std::string& command_line) {
  ProgramOutput output;
  std::FILE* pipe = ::popen((command_line + " 2>&1").c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + command_line);
  char block[4096];
  for (std::size_t count; (count = std::fread(block, 1, sizeof block, pipe)) > 0;)
    output.text.append(block, count);
  const int status = ::pclose(pipe);
  output.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return output;
}

}  // namespace selvage::testing
