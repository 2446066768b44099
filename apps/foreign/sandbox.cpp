#include "apps/foreign/sandbox.h"

#include <linux/landlock.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
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

/// landlock_ruleset_attr as version 6 has it, which the headers of this system need not know: what is there is forbidden. Earlier
/// versions know a shorter one.
struct Ruleset {
  std::uint64_t files = 0;   ///< a bit for each kind of access
  std::uint64_t tcp = 3;     ///< to bind and to connect
  std::uint64_t scopes = 3;  ///< beyond this process: abstract sockets, and signals
};

/// Never more than before, which only a superuser might set.
bool limit(__rlimit_resource_t resource, rlim_t most) {
  rlimit limits{};
  if (::getrlimit(resource, &limits) != 0) {
    return false;
  }
  limits.rlim_cur = limits.rlim_max = std::min(most, limits.rlim_max);
  return ::setrlimit(resource, &limits) == 0;
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

bool allows(const Filter& filter, int call) { return seccomp_rule_add(filter.get(), SCMP_ACT_ALLOW, call, 0) == 0; }

bool allows_if(const Filter& filter, int call, const scmp_arg_cmp& condition) {
  return seccomp_rule_add_array(filter.get(), SCMP_ACT_ALLOW, call, 1, &condition) == 0;
}

/// Anything else fails, as it does for want of rights. No memory can be run, and no process ended but this one.
bool filter_calls() {
  const Filter filter(seccomp_init(SCMP_ACT_ERRNO(EPERM)), seccomp_release);
  const scmp_arg_cmp plain{2, SCMP_CMP_MASKED_EQ, PROT_EXEC, 0}, own{0, SCMP_CMP_EQ, static_cast<scmp_datum_t>(::getpid()), 0};
  return filter && std::all_of(calls.begin(), calls.end(), [&](int call) { return allows(filter, call); }) &&
         allows_if(filter, SCMP_SYS(mmap), plain) && allows_if(filter, SCMP_SYS(mprotect), plain) &&
         allows_if(filter, SCMP_SYS(tgkill), own) && seccomp_attr_set(filter.get(), SCMP_FLTATR_CTL_TSYNC, 1) == 0 &&
         seccomp_load(filter.get()) == 0;
}

bool limit_all(std::uint64_t memory_bytes) {
  const std::uint64_t most = std::numeric_limits<rlim_t>::max() / 2, taken = address_space_bytes();
  const bool is_memory_limited = limit(RLIMIT_AS, memory_bytes < most - taken ? taken + memory_bytes : RLIM_INFINITY);
  const bool are_files_limited = limit(RLIMIT_CORE, 0) && limit(RLIMIT_FSIZE, 0) && limit(RLIMIT_NOFILE, files_max);
  return is_memory_limited && are_files_limited && limit(RLIMIT_NPROC, 0);
}

}  // namespace

bool tie_to_parent() { return ::prctl(PR_SET_PDEATHSIG, SIGKILL) == 0; }

void be_first_to_end() { std::ofstream("/proc/self/oom_score_adj") << 1000; }

/// Uses Landlock (kernel 5.13 and later). Later versions know more file accesses and other resources.
Forbidden forbid_by_landlock() {
  const long version = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 1) {
    return {};
  }
  constexpr long has_tcp = 4, has_devices = 5, has_scopes = 6;
  const int kinds = version == 1 ? 13 : version == 2 ? 14 : version < has_devices ? 15 : 16;
  const Ruleset all{.files = (std::uint64_t{1} << kinds) - 1};
  const std::size_t bytes = sizeof(std::uint64_t) * (version < has_tcp ? 1 : version < has_scopes ? 2 : 3);
  const long rules = ::syscall(SYS_landlock_create_ruleset, &all, bytes, 0);
  const bool is_forbidden =
      rules >= 0 && ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && ::syscall(SYS_landlock_restrict_self, rules, 0) == 0;
  if (rules >= 0) {
    ::close(static_cast<int>(rules));
  }
  return {is_forbidden, is_forbidden && version >= has_scopes};
}

Confinement enter_sandbox(std::uint64_t memory_bytes) {
  Confinement confinement{.are_limits_set = limit_all(memory_bytes)};
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  const Forbidden forbidden = forbid_by_landlock();  // a second wall
  confinement.are_files_forbidden = forbidden.are_files;
  confinement.is_reach_forbidden = forbidden.is_reach;
  confinement.are_calls_filtered = filter_calls();
  return confinement;
}

}  // namespace dmpc::apps
