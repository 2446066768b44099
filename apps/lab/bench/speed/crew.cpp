#include "apps/lab/bench/speed/crew.h"

#include <exception>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::apps {

void on_threads(std::size_t count, const std::function<void(std::size_t)>& work) {
  std::vector<std::exception_ptr> failures(count);
  const auto run = [&](std::size_t index) {
    try {
      work(index);
    } catch (...) {
      failures[index] = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> crew;
    crew.reserve(count);
    try {
      for (std::size_t index = 0; index + 1 < count; ++index) {
        crew.emplace_back(run, index);
      }
    } catch (const std::system_error&) {
      throw core::RoomError("this takes " + std::to_string(count) + " threads, and this computer lets dmpc start but " +
                            std::to_string(crew.size()) + ": ask for a higher limit (ulimit -u, pids.max of a container)");
    }
    if (count > 0) {
      run(count - 1);
    }
  }
  for (const std::exception_ptr& failure : failures) {
    if (failure) {
      std::rethrow_exception(failure);
    }
  }
}

}  // namespace dmpc::apps
