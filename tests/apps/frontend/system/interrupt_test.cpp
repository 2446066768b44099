#include "apps/frontend/system/interrupt.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <mutex>
#include <string>
#include <thread>

#include "apps/frontend/line/exit_status.h"
#include "tests/support/forked_process.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::apps::interrupt_test {

namespace {

/// What `body` returns, as the exit status of a process of its own: signals must find no other threads than Interrupt's.
int in_child(int (*body)()) { return tests::ForkedProcess(body).status(); }

/// Sends the signal and waits until a stop was requested, ten seconds at most.
bool stops_after(const Interrupt& interrupt, int signal) {
  ::kill(::getpid(), signal);
  std::mutex mutex;
  std::condition_variable_any changed;
  std::unique_lock lock(mutex);
  changed.wait_for(lock, interrupt.token(), std::chrono::seconds(10), [] { return false; });
  return interrupt.requested();
}

template <class Body>
bool is_interrupted(const Body& body) {
  try {
    body();
    return false;
  } catch (const Interrupted&) {
    return true;
  }
}

}  // namespace

TEST_CASE("without a signal nothing is requested") {
  const Interrupt interrupt;
  CHECK_FALSE(interrupt.requested());
  CHECK_NOTHROW(interrupt.check());
}

TEST_CASE("signals that would end a process request a stop and end nothing") {
  CHECK(in_child([] {
          for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGALRM, SIGUSR1, SIGUSR2}) {
            const Interrupt interrupt;
            if (!stops_after(interrupt, signal) || !is_interrupted([&] { interrupt.check(); })) {
              return 1;
            }
          }
          return 0;
        }) == 0);
}

TEST_CASE("where what is done can be kept SIGUSR1 asks for that, once each time, and stops nothing") {
  CHECK(in_child([] {
          Interrupt interrupt;
          interrupt.take_usr1_for_keep();
          if (interrupt.take_keep_request()) {
            return 1;
          }
          ::kill(::getpid(), SIGUSR1);
          for (int tries = 0; tries < 10'000 && !interrupt.take_keep_request(); ++tries) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            if (tries == 9'999) {
              return 2;
            }
          }
          return interrupt.take_keep_request() || interrupt.requested() ? 3 : stops_after(interrupt, SIGUSR2) ? 0 : 4;
        }) == 0);
}

TEST_CASE("a signal that was ignored before stays ignored") {
  CHECK(in_child([] {
          std::signal(SIGHUP, SIG_IGN);
          Interrupt interrupt;
          const Interrupt::EndAtOnce end_at_once(interrupt);
          ::kill(::getpid(), SIGHUP);
          ::usleep(100'000);
          return interrupt.requested() ? 1 : 0;
        }) == 0);
}

TEST_CASE("a scope that would end the process at once is not entered after a signal") {
  CHECK(in_child([] {
          Interrupt interrupt;
          { const Interrupt::EndAtOnce end_at_once(interrupt); }
          if (!stops_after(interrupt, SIGINT)) {
            return 1;
          }
          return is_interrupted([&] { const Interrupt::EndAtOnce end_at_once(interrupt); }) ? 0 : 2;
        }) == 0);
}

TEST_CASE("a scope that passes over what came before is ended by what comes then") {
  CHECK(in_child([] {
          Interrupt interrupt;
          if (!stops_after(interrupt, SIGINT)) {
            return 1;
          }
          const Interrupt::EndAtOnce end_at_once(interrupt, Interrupt::EndAtOnce::Before::is_passed_over);
          ::kill(::getpid(), SIGINT);
          ::sleep(10);
          return 2;
        }) == interrupted_status);
}

TEST_CASE("in such a scope a signal ends the process with status 130") {
  CHECK(in_child([] {
          Interrupt interrupt;
          const Interrupt::EndAtOnce end_at_once(interrupt);
          ::kill(::getpid(), SIGTERM);
          ::sleep(10);
          return 0;
        }) == interrupted_status);
}

TEST_CASE("a second signal ends the process with status 130 whatever it is doing") {
  CHECK(in_child([] {
          const Interrupt interrupt;
          if (!stops_after(interrupt, SIGTERM)) {
            return 1;
          }
          ::kill(::getpid(), SIGINT);
          ::sleep(10);
          return 0;
        }) == interrupted_status);
}

TEST_CASE("an end at once removes the files that ask for it, and those only") {
  static const tests::TemporaryFolder folder;
  CHECK(in_child([] {
          for (const char* name : {"early", "kept", "half", "other"}) {
            tests::write_text(folder / name, "some");
          }
          Interrupt interrupt;
          const Interrupt::EndAtOnce end_at_once(interrupt);
          { const RemovedAtOnce early(folder / "early"); }
          const RemovedAtOnce half(folder / "half"), other(folder / "other"), missing(folder / "missing");
          ::kill(::getpid(), SIGTERM);
          ::sleep(10);
          return 0;
        }) == interrupted_status);
  CHECK(folder.entry_count() == 2);
  CHECK(tests::file_text(folder / "early") == "some");
  CHECK(tests::file_text(folder / "kept") == "some");
}

TEST_CASE("where a file was, an end at once leaves a folder alone that somebody has put there") {
  static const tests::TemporaryFolder folder;
  CHECK(in_child([] {
          Interrupt interrupt;
          const Interrupt::EndAtOnce end_at_once(interrupt);
          const RemovedAtOnce file(folder / "swapped");
          std::filesystem::create_directory(folder / "swapped");
          tests::write_text(folder / "swapped/dear", "some");
          ::kill(::getpid(), SIGTERM);
          ::sleep(10);
          return 0;
        }) == interrupted_status);
  CHECK(tests::file_text(folder / "swapped/dear") == "some");
}

TEST_CASE("what an interruption means for the outputs can be said, and is nothing at first") {
  Interrupt interrupt;
  CHECK(std::string(interrupt.consequence()) == "nothing was written");
  interrupt.set_consequence("half");
  CHECK(std::string(interrupt.consequence()) == "half");
}

}  // namespace dmpc::apps::interrupt_test
