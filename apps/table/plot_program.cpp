#include "apps/table/plot_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "apps/system/output_file.h"
#include "apps/system/shortage.h"
#include "core/base/expect.h"

// NOLINTNEXTLINE(readability-redundant-declaration): POSIX leaves its declaration to the program
extern char** environ;

namespace dmpc::apps {

namespace fs = std::filesystem;

namespace {

/// Of what a program says; the rest is read and forgotten.
constexpr std::size_t words_bytes_max = 2000;

/// Both ends are closed in the end, unless before.
class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0) {
      const int error = errno;
      throw_if_short(error, "no pipe to a program can be made");
      throw core::InternalError(std::string("no pipe to a program can be made: ") + std::strerror(error));
    }
  }
  ~Pipe() {
    close_writing();
    ::close(ends_[0]);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int writing() const { return ends_[1]; }
  void close_writing() {
    if (int& end = ends_[1]; end >= 0) {
      ::close(std::exchange(end, -1));
    }
  }
  /// Until all who could write have closed their end.
  std::string read_all() const {
    std::string text;
    std::array<char, 512> part{};
    for (;;) {
      const ssize_t count = ::read(ends_[0], part.data(), part.size());
      if (count > 0) {
        text.append(part.data(), static_cast<std::size_t>(count));
        text.resize(std::min(text.size(), words_bytes_max));
      } else if (count == 0 || errno != EINTR) {
        return text;
      }
    }
  }

 private:
  std::array<int, 2> ends_{};
};

/// What the child is given: nothing to read, nobody to write to but us, and signals as at a program's start.
class Surroundings {
 public:
  Surroundings(const fs::path& folder, int errors) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawnattr_init(&attributes_);
    posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions_, errors, STDERR_FILENO);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes_, &none);
    sigset_t ignored = none;
    sigaddset(&ignored, SIGPIPE);
    sigaddset(&ignored, SIGXFSZ);
    posix_spawnattr_setsigdefault(&attributes_, &ignored);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  ~Surroundings() {
    posix_spawnattr_destroy(&attributes_);
    posix_spawn_file_actions_destroy(&actions_);
  }
  Surroundings(const Surroundings&) = delete;
  Surroundings& operator=(const Surroundings&) = delete;

  /// An error's number, or 0.
  int spawn(pid_t& id, const std::string& program, const std::string& argument) const {
    std::string first = program, second = argument;
    const std::array<char*, 3> words = {first.data(), second.data(), nullptr};
    return ::posix_spawnp(&id, program.c_str(), &actions_, &attributes_, words.data(), environ);
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

/// The words without empty lines, on one line.
std::string on_one_line(const std::string& words) {
  std::string line;
  for (const char character : words) {
    const bool is_space = character == ' ' || character == '\n' || character == '\t';
    if (!is_space || (!line.empty() && line.back() != ' ')) {
      line += is_space ? ' ' : character;
    }
  }
  return line.substr(0, line.find_last_not_of(' ') + 1);
}

std::string end_of(pid_t id) {
  int status = 0;
  while (::waitpid(id, &status, 0) < 0) {
    core::expect(errno == EINTR, "a child can be waited for");
  }
  if (WIFSIGNALED(status)) {
    return "it was ended by signal " + std::to_string(WTERMSIG(status));
  }
  return WEXITSTATUS(status) == 0 ? "" : "its exit status is " + std::to_string(WEXITSTATUS(status));
}

PlotOutcome run_script(const fs::path& folder, const std::string& name, const std::string& program) {
  Pipe pipe;
  pid_t id = 0;
  if (const int error = Surroundings(folder, pipe.writing()).spawn(id, program, name + ".gnuplot"); error != 0) {
    return {.is_program_missing = true, .complaint = program + " cannot be started: " + std::strerror(error)};
  }
  pipe.close_writing();
  const std::string words = on_one_line(pipe.read_all()), end = end_of(id);
  std::error_code ignored;
  if (end.empty() && fs::exists(folder / (name + ".svg"), ignored)) {
    return {.is_drawn = true};
  }
  return {.complaint = program + " could not draw " + name + ".svg" + (end.empty() ? "" : ", " + end) +
                       (words.empty() ? "" : ": " + words)};
}

}  // namespace

std::string sentence_on(const PlotOutcome& outcome) {
  return outcome.is_program_missing ? "the plots are not drawn: " + outcome.complaint +
                                          " (package gnuplot-nox); once it is there, `gnuplot *.gnuplot` in the folder draws them"
                                    : outcome.complaint;
}

std::optional<PlotOutcome> draw(const Plot& plot, const Table& table, const fs::path& folder, const std::string& data_file,
                                const std::string& program) {
  const fs::path script_path = folder / (plot.name + ".gnuplot"), picture_path = folder / (plot.name + ".svg");
  std::error_code ignored;
  fs::remove(picture_path, ignored);
  const std::optional<std::string> script = script_of(plot, table, data_file);
  if (!script) {
    fs::remove(script_path, ignored);
    return std::nullopt;
  }
  write_file(script_path, *script, Durability::until_power_loss);
  PlotOutcome outcome = run_script(folder, plot.name, program);
  if (!outcome.is_drawn) {
    fs::remove(picture_path, ignored);
  }
  return outcome;
}

}  // namespace dmpc::apps
