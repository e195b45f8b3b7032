// SPDX-License-Identifier: MIT
//
// A selvage-server as operators run it: a process of its own, which tests stop, kill and start again.
#pragma once

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/net/tcp_stream.h"

namespace selvage::testing {

class ServerProcess {
 public:
  /// Its log goes to a file. Call address() to wait until it listens.
  ServerProcess(const std::string& program, std::vector<std::string> arguments, std::filesystem::path log)
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
      const int file = ::open(log_path.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
      ::dup2(out[1], STDOUT_FILENO);
      ::dup2(file, STDERR_FILENO);
      ::execv(program.c_str(), argv.data());
      ::_exit(127);
    }
    ::close(out[1]);
    stdout_ = ::fdopen(out[0], "r");
  }
  ~ServerProcess() {
    if (pid_ > 0) end(SIGKILL);
    std::fclose(stdout_);
  }
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  /// Waits until it says where it listens; throws what it logged if it ends before.
  HostPort address() {
    if (address_.port != 0) return address_;
    char line[256] = {};
    const std::string said = std::fgets(line, sizeof line, stdout_) != nullptr ? line : "";
    const std::string prefix = "listening on ";
    if (!said.starts_with(prefix)) throw std::runtime_error("the server does not start: " + log());
    const std::string text = said.substr(prefix.size(), said.size() - prefix.size() - 1);
    address_ = parse_host_port(text).value();
    return address_;
  }

  void signal(int number) { ::kill(pid_, number); }

  /// Sends the signal, unless 0, and waits; the exit code, or minus the signal that ended it.
  int end(int number) {
    if (number != 0) ::kill(pid_, number);
    int status = 0;
    ::waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  std::string log() const {
    std::ostringstream text;
    text << std::ifstream(log_).rdbuf();
    return text.str();
  }

 private:
  const std::filesystem::path log_;
  pid_t pid_ = -1;
  std::FILE* stdout_ = nullptr;
  HostPort address_;
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
