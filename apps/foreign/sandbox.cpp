#include "apps/foreign/sandbox.h"

#include <seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <limits>
#include <memory>

namespace dmpc::apps {
namespace {

/// The line, the three that each process has, and files that are handed over, one at a time.
constexpr rlim_t files_max = 64;

void limit(__rlimit_resource_t resource, rlim_t most) {
  const rlimit limits{most, most};
  ::setrlimit(resource, &limits);
}

std::uint64_t address_space_bytes() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

/// What memory, the line and an orderly end need; and what a thread of OpenImageIO's does that starts beside us.
constexpr std::array calls{SCMP_SYS(read),
                           SCMP_SYS(pread64),
                           SCMP_SYS(write),
                           SCMP_SYS(lseek),
                           SCMP_SYS(close),
                           SCMP_SYS(recvmsg),
                           SCMP_SYS(sendmsg),
                           SCMP_SYS(brk),
                           SCMP_SYS(munmap),
                           SCMP_SYS(mremap),
                           SCMP_SYS(madvise),
                           SCMP_SYS(futex),
                           SCMP_SYS(rt_sigreturn),
                           SCMP_SYS(rt_sigprocmask),
                           SCMP_SYS(sigaltstack),
                           SCMP_SYS(gettid),
                           SCMP_SYS(getpid),
                           SCMP_SYS(clock_gettime),
                           SCMP_SYS(gettimeofday),
                           SCMP_SYS(time),
                           SCMP_SYS(getrandom),
                           SCMP_SYS(sched_yield),
                           SCMP_SYS(sched_getaffinity),
                           SCMP_SYS(sysinfo),
                           SCMP_SYS(rseq),
                           SCMP_SYS(set_robust_list),
                           SCMP_SYS(restart_syscall),
                           SCMP_SYS(exit),
                           SCMP_SYS(exit_group)};

using Filter = std::unique_ptr<void, void (*)(scmp_filter_ctx)>;

void allow(const Filter& filter, int call) { seccomp_rule_add(filter.get(), SCMP_ACT_ALLOW, call, 0); }

/// No memory that can be run.
void allow_unless_executable(const Filter& filter, int call) {
  const scmp_arg_cmp plain{2, SCMP_CMP_MASKED_EQ, PROT_EXEC, 0};
  seccomp_rule_add_array(filter.get(), SCMP_ACT_ALLOW, call, 1, &plain);
}

void allow_own_end(const Filter& filter) {
  const scmp_arg_cmp own{0, SCMP_CMP_EQ, static_cast<scmp_datum_t>(::getpid()), 0};
  seccomp_rule_add_array(filter.get(), SCMP_ACT_ALLOW, SCMP_SYS(tgkill), 1, &own);
}

/// Anything else fails, as it does for want of rights.
bool filter_calls() {
  const Filter filter(seccomp_init(SCMP_ACT_ERRNO(EPERM)), seccomp_release);
  if (!filter) {
    return false;
  }
  for (const int call : calls) {
    allow(filter, call);
  }
  allow_unless_executable(filter, SCMP_SYS(mmap));
  allow_unless_executable(filter, SCMP_SYS(mprotect));
  allow_own_end(filter);
  seccomp_attr_set(filter.get(), SCMP_FLTATR_CTL_TSYNC, 1);
  return seccomp_load(filter.get()) == 0;
}

}  // namespace

void tie_to_parent() {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::ofstream("/proc/self/oom_score_adj") << 1000;
}

bool enter_sandbox(std::uint64_t memory_bytes) {
  const std::uint64_t most = std::numeric_limits<rlim_t>::max() / 2, taken = address_space_bytes();
  limit(RLIMIT_AS, memory_bytes < most - taken ? taken + memory_bytes : RLIM_INFINITY);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);
  limit(RLIMIT_NOFILE, files_max);
  limit(RLIMIT_NPROC, 0);
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  return filter_calls();
}

}  // namespace dmpc::apps
