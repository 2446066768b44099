// Preloaded into a program, this runs it again and again, each time from its main() on, in a process of its own where one
// allocation fails, or all from one on: malloc() and its like give nullptr, and operator new throws. What stands in the
// environment:
//   DMPC_FAILURES=FOLDER,FIRST,STEP,COUNT,MODE
// The run N, of COUNT, is in the new folder FOLDER/rN, fails the allocation FIRST + N * STEP, of all threads' together, and ends
// there (by SIGALRM) after two minutes. It leaves its errors in FOLDER/N.errors. MODE: one, or all from that one on. On stdout
// stands a line for each: the allocation, how many there were, and how the process ended: an exit status, or 1000 + signal. COUNT
// 0: the program runs once without failures, in FOLDER.
//
// Allocations before main() never fail: what throws there ends a process whatever it does.

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
}

namespace {

using Main = int (*)(int, char**, char**);

/// What the process that runs the others learns of one.
struct Shared {
  std::atomic<unsigned long> calls;
};

enum class Mode { one, all, threads };

Shared* shared = nullptr;  ///< nullptr: nothing is counted, nothing fails
unsigned long fails_at = 0;
Mode mode = Mode::one;
Main program_main = nullptr;

bool fails(bool is_thread) {
  if (shared == nullptr || is_thread != (mode == Mode::threads)) {
    return false;
  }
  const unsigned long number = ++shared->calls;
  return fails_at > 0 && (mode == Mode::one ? number == fails_at : number >= fails_at);
}

bool fails() {
  const bool does = fails(false);
  if (does) {
    errno = ENOMEM;
  }
  return does;
}

struct Orders {
  char folder[4096];
  unsigned long first, step, count;
  char mode[8];
};

void send_errors_to(const char* folder, unsigned long run) {
  char name[4200];
  std::snprintf(name, sizeof(name), "%s/%lu.errors", folder, run);
  const int file = ::open(name, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ::dup2(file, STDERR_FILENO);
  ::close(file);
  ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO);
}

/// In a folder of its own.
void enter(const char* folder, unsigned long run) {
  char name[4200];
  std::snprintf(name, sizeof(name), "%s/r%lu", folder, run);
  if (::mkdir(name, 0700) != 0 || ::chdir(name) != 0) {
    ::_exit(126);
  }
}

int status_of(pid_t process) {
  int status = 0;
  ::waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

int run_all(int count, char** values, char** environment) {
  Orders orders{};
  const char* const text = std::getenv("DMPC_FAILURES");
  if (text == nullptr || std::sscanf(text, "%4095[^,],%lu,%lu,%lu,%7s", orders.folder, &orders.first, &orders.step, &orders.count,
                                     orders.mode) != 5) {
    std::fprintf(stderr, "expected DMPC_FAILURES=FOLDER,FIRST,STEP,COUNT,MODE\n");
    return 126;
  }
  ::unsetenv("LD_PRELOAD");
  auto* const memory =
      static_cast<Shared*>(::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  const bool is_calm = orders.count == 0;
  for (unsigned long run = 0; run < (is_calm ? 1 : orders.count); ++run) {
    memory->calls = 0;
    const unsigned long at = is_calm ? 0 : orders.first + run * orders.step;
    std::fflush(stdout);
    const pid_t process = ::fork();
    if (process == 0) {
      send_errors_to(orders.folder, run);
      enter(orders.folder, run);
      const itimerval alarms{{1, 0}, {60, 0}};  // the first asks it to stop, the second ends it
      ::setitimer(ITIMER_REAL, &alarms, nullptr);
      fails_at = at;
      mode = std::strcmp(orders.mode, "all") == 0       ? Mode::all
             : std::strcmp(orders.mode, "threads") == 0 ? Mode::threads
                                                        : Mode::one;
      shared = memory;
      const int status = program_main(count, values, environment);
      std::fflush(nullptr);
      ::_exit(status);  // libraries wait in their destructors for threads that a fork does not take along
    }
    const int status = status_of(process);
    std::printf("%lu %lu %d\n", at, memory->calls.load(), status);
  }
  std::fflush(stdout);
  ::_exit(0);
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) { return fails() ? nullptr : __libc_malloc(size); }
void* calloc(std::size_t count, std::size_t size) { return fails() ? nullptr : __libc_calloc(count, size); }
void* realloc(void* block, std::size_t size) { return fails() ? nullptr : __libc_realloc(block, size); }
void* memalign(std::size_t alignment, std::size_t size) { return fails() ? nullptr : __libc_memalign(alignment, size); }
void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }

int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  void* const made = memalign(alignment, size);
  if (made == nullptr) {
    return ENOMEM;
  }
  *block = made;
  return 0;
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*body)(void*), void* argument) {
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto create = reinterpret_cast<Create>(::dlsym(RTLD_NEXT, "pthread_create"));
  return fails(true) ? EAGAIN : create(thread, attributes, body, argument);
}

int __libc_start_main(Main main, int count, char** values, void (*begin)(), void (*end)(), void (*unload)(), void* stack) {
  using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
  const auto start = reinterpret_cast<Start>(::dlsym(RTLD_NEXT, "__libc_start_main"));
  program_main = main;
  return start(&run_all, count, values, begin, end, unload, stack);
}

}  // extern "C"
