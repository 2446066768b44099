#include "apps/frontend/system/last_words.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>

#include "apps/frontend/line/exit_status.h"
#include "tests/support/forked_process.h"

namespace dmpc::tests::last_words_test {

#if !defined(__SANITIZE_ADDRESS__)  // which reports crashes itself
TEST_CASE("a crash where memory has run out is a want of memory") {
  CHECK(ForkedProcess([] {
          apps::end_without_abort();
          errno = ENOMEM;
          std::abort();
          return 0;
        }).status() == apps::no_capacity_status);
}

TEST_CASE("a crash that another process sends is no want of memory, whatever was before") {
  CHECK(ForkedProcess([] {
          apps::end_without_abort();
          if (::fork() == 0) {
            ::kill(::getppid(), SIGSEGV);
            ::_exit(0);
          }
          for (int i = 0; i < 1000; ++i) {
            errno = ENOMEM;
            ::usleep(10'000);
          }
          return 0;
        }).status() == 1000 + SIGSEGV);
}
#endif

}  // namespace dmpc::tests::last_words_test
