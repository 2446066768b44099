#include "apps/reader/process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <ctime>
#include <iostream>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/system/available_memory.h"
#include "apps/frontend/system/companion_path.h"
#include "apps/frontend/system/memory_file.h"
#include "apps/frontend/system/resource_exhaustion.h"
#include "core/base/expect.h"

// NOLINTNEXTLINE(readability-redundant-declaration): POSIX leaves its declaration to the program
extern char** environ;

namespace dmpc::apps {
namespace {

/// Where a reader finds its end of the line.
constexpr int line_number = 3;
/// Why one is ended that might go on.
constexpr const char* out_of_time = "has no time left";

/// The terminal's signals are for dmpc, whose end is its reader's end, too.
void set_signals(posix_spawnattr_t& attributes) {
  sigset_t blocked;
  sigemptyset(&blocked);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
    sigaddset(&blocked, signal);
  }
  posix_spawnattr_setsigmask(&attributes, &blocked);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
}

/// Its stderr goes to a file, from which errors are reported if it does not get ready.
int spawn(pid_t& id, const std::string& program, int line, int errors) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
  posix_spawn_file_actions_adddup2(&actions, line, line_number);
  posix_spawn_file_actions_addclosefrom_np(&actions, line_number + 1);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  set_signals(attributes);
  std::string name = program;
  std::array<char*, 2> words{name.data(), nullptr};
  const int error = ::posix_spawn(&id, program.c_str(), &actions, &attributes, words.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

/// Libraries that get ready start threads, and abort where they cannot.
[[noreturn]] void fail_to_start(const std::string& program, const std::string& how, const std::string& complaint) {
  const std::string what = program + ", which reads or writes files for dmpc, cannot be started";
  throw_if_short(complaint, what);
  throw core::InternalError(what + ": it " + how + (complaint.empty() ? "" : ", saying: " + complaint));
}

/// Once.
[[maybe_unused]] void say_what_is_missing(const std::string& missing) {
  [[maybe_unused]] static const bool is_said = [&] {
    std::cerr << "dmpc: " << missing << ": read none that you do not trust, or ask for --sandbox=required\n";
    return true;
  }();
}

}  // namespace

ReaderProcess::ReaderProcess(const std::string& program, std::uint64_t memory_bytes, ReadingBudget& budget)
    : memory_bytes_(memory_bytes), line_(Descriptor()) {
  const std::string path =
      companion_path(program, "../libexec/dmpc", "the program " + program + ", which reads or writes files for dmpc,").string();
  auto [ours, its] = make_ends();
  line_ = Line(std::move(ours));
  const MemoryFile errors;
  start(path, its, errors.descriptor());
  its = Descriptor();  // else its death would not close the line
  allow();
  Confinement confinement;
  try {
    send(Saying::limits, Packer().add(memory_bytes));
    confinement = hear_that_it_is_ready();
  } catch (const core::InputError& error) {
    fail_to_start(path, error.what(), errors.bytes());
  }
  taken_to_start_ = taken();
  budget_ = &budget;
  allow();
  check(confinement);
}

ReaderProcess::~ReaderProcess() {
  if (id_ > 0) {
    budget_->spend(taken() - taken_to_start_);
    stop();
  }
}

void ReaderProcess::stop() {
  ::kill(id_, SIGKILL);
  ::waitpid(std::exchange(id_, -1), nullptr, 0);
}

void ReaderProcess::start(const std::string& program, const Descriptor& its_end, int errors) {
  const int error = spawn(id_, program, its_end.number(), errors);
  if (error != 0) {
    id_ = -1;
    fail_to_start(program, "does not begin", std::strerror(error));
  }
}

Confinement ReaderProcess::hear_that_it_is_ready() {
  const Message message = receive();
  Unpacker fields(message.bytes);
  Unpacker::require(message.saying == Saying::ready && fields.take<std::uint32_t>() == protocol);
  Confinement confinement;
  for (bool* const flag : {&confinement.are_calls_filtered, &confinement.are_limits_set, &confinement.are_files_forbidden,
                           &confinement.is_reach_forbidden, &confinement.ends_with_dmpc}) {
    *flag = fields.take_flag();
  }
  return confinement;
}

void ReaderProcess::check(const Confinement& confinement) {
  if (budget_->limits().sandbox == Sandbox::none) {
    return;
  }
  add_reader(confinement);
  if (confinement.is_full()) {
    return;
  }
  const std::string missing = missing_text(confinement);
  if (budget_->limits().sandbox == Sandbox::required) {
    stop();
    throw core::InputError(missing + ": nothing is read, as --sandbox=required asks");
  }
#if !defined(__SANITIZE_ADDRESS__)  // under which none is
  say_what_is_missing(missing);
#endif
}

ReadingBudget::Time ReaderProcess::taken() const {
  clockid_t clock{};
  timespec taken{};
  const bool is_known = ::clock_getcpuclockid(id_, &clock) == 0 && ::clock_gettime(clock, &taken) == 0;
  return is_known ? std::chrono::seconds(taken.tv_sec) + std::chrono::nanoseconds(taken.tv_nsec) : ReadingBudget::Time{};
}

void ReaderProcess::allow() {
  const auto most = std::chrono::ceil<std::chrono::seconds>(taken_to_start_ + budget_->left()).count();
  rlimit limit{};
  ::prlimit(id_, RLIMIT_CPU, nullptr, &limit);
  limit.rlim_cur = std::min(static_cast<rlim_t>(std::max<std::int64_t>(most, 1)), limit.rlim_max);
  ::prlimit(id_, RLIMIT_CPU, &limit, nullptr);  // where that is refused, the wall's clock is left
}

void ReaderProcess::send(Saying saying, const Packer& fields, const Descriptor* file, std::uint64_t file_bytes) {
  budget_->add_bytes(file_bytes);
  if (budget_->left() <= taken() - taken_to_start_) {
    end(out_of_time);
  }
  allow();
  if (!line_.send(saying, fields, file == nullptr ? -1 : file->number(), false)) {
    end("does not listen");
  }
}

void ReaderProcess::send_bytes(std::span<const std::byte> bytes) {
  if (!dmpc::apps::send_bytes(bytes, line_)) {
    end("does not listen");
  }
}

/// All waiting together is bounded: messages, however many, renew nothing. Who looks up much later than it wanted to was stopped,
/// and so was the reader, perhaps.
void ReaderProcess::wait_for_message() {
  constexpr std::chrono::milliseconds look{1000};
  pollfd entry{.fd = line_.descriptor(), .events = POLLIN, .revents = 0};
  for (int ready = 0; ready <= 0;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(budget_->wall_left()).count();
    if (left <= 0) {
      end("took too long");
    }
    const auto begin = std::chrono::steady_clock::now();
    ready = ::poll(&entry, 1, static_cast<int>(std::min<std::int64_t>(left, look.count())));
    budget_->wait(std::min<ReadingBudget::Time>(std::chrono::steady_clock::now() - begin, 2 * look));
  }
}

Message ReaderProcess::receive() {
  wait_for_message();
  std::optional<Message> message = line_.receive(false);
  if (!message) {
    end("ended without a word");
  }
  if (message->saying == Saying::out_of_memory) {
    const std::uint64_t most = std::min(memory_bytes_, available_memory().bytes);  // addresses of a large file are not all memory
    throw core::CapacityError("took more than the " + mebibytes_text(most) + " of memory that it may take");
  }
  return std::move(*message);
}

/// It is not waited for yet, so its number is no other process's. What it names again and again costs it nothing, so there is a
/// bound.
bool ReaderProcess::copy(std::uint64_t address, std::span<std::byte> room, std::uint64_t growth) {
  grown_bytes_ += growth * room.size();
  const iovec here{room.data(), room.size()},
      there{reinterpret_cast<void*>(address), room.size()};  // NOLINT(performance-no-int-to-ptr)
  return grown_bytes_ <= memory_bytes_ && ::process_vm_readv(id_, &here, 1, &there, 1, 0) == static_cast<ssize_t>(room.size());
}

void ReaderProcess::end(const char* unless_by_signal) {
  ::kill(id_, SIGKILL);  // changes nothing of an end that has begun
  int status = 0;
  rusage used{};
  ::wait4(std::exchange(id_, -1), &status, 0, &used);
  for (const timeval& time : {used.ru_utime, used.ru_stime}) {  // the start included: one that dies has to be started anew
    budget_->spend(std::chrono::seconds(time.tv_sec) + std::chrono::microseconds(time.tv_usec));
  }
  if ((WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) || unless_by_signal == out_of_time) {
    throw ReaderDeath("took more than " + counted(budget_->seconds(), "second") + " of processor time");
  }
  if (WIFSIGNALED(status) && WTERMSIG(status) != SIGKILL) {
    throw ReaderDeath("crashed (signal " + std::to_string(WTERMSIG(status)) + ", " + ::strsignal(WTERMSIG(status)) + ")");
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) != 0) {
    throw ReaderDeath("ended with status " + std::to_string(WEXITSTATUS(status)));
  }
  const bool is_over = budget_->wall_left() < std::chrono::milliseconds(1);
  throw ReaderDeath(is_over ? "took more than " + counted(budget_->wall_seconds(), "second") : unless_by_signal);
}

}  // namespace dmpc::apps
