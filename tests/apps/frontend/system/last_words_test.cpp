#include "apps/frontend/system/last_words.h"

#include <doctest/doctest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
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

TEST_CASE("a fault in a mapped file that somebody has cut is an error of input, and no crash") {
  CHECK(ForkedProcess([] {
          apps::end_without_abort();
          constexpr std::size_t bytes = 4096;
          const int file = ::memfd_create("cut", 0);
          const bool is_long = ::ftruncate(file, bytes) == 0;
          const auto* const first = static_cast<const std::byte*>(::mmap(nullptr, bytes, PROT_READ, MAP_PRIVATE, file, 0));
          const apps::MappedBytes mapped({first, bytes}, "cut.pages");
          const bool is_cut = ::ftruncate(file, 0) == 0;
          return is_long && is_cut ? 2 + static_cast<int>(*static_cast<const volatile std::byte*>(first)) : 3;
        }).status() == apps::input_status);
}
#endif

}  // namespace dmpc::tests::last_words_test
