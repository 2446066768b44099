#include "apps/lab/bench/speed/crew.h"

#include <future>
#include <string>
#include <system_error>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::apps {

void on_threads(std::size_t count, const std::function<void(std::size_t)>& work) {
  std::vector<std::future<void>> crew;  // who is waited for in the end, whatever is thrown
  try {
    for (std::size_t index = 0; index + 1 < count; ++index) {
      crew.push_back(std::async(std::launch::async, work, index));
    }
  } catch (const std::system_error&) {
    throw core::RoomError("this takes " + std::to_string(count) + " threads, and this computer lets dmpc start but " +
                          std::to_string(crew.size()) + ": ask for a higher limit (ulimit -u, pids.max of a container)");
  }
  if (count > 0) {
    work(count - 1);
  }
  for (std::future<void>& one : crew) {
    one.get();
  }
}

}  // namespace dmpc::apps
