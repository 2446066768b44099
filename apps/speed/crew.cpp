#include "apps/speed/crew.h"

#include <exception>
#include <thread>
#include <vector>

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
    for (std::size_t index = 0; index + 1 < count; ++index) {
      crew.emplace_back(run, index);
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
