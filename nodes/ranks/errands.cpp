#include "nodes/ranks/errands.h"

#include <utility>

#include "nodes/ranks/dismissal.h"
#include "nodes/ranks/fabric.h"

namespace dmpc::nodes {

void Errands::send(const std::function<void()>& errand) {
  std::packaged_task<void()> task([this, &errand] { failure_ ? std::rethrow_exception(failure_) : errand(); });
  std::future<void> done = task.get_future();
  {
    const std::lock_guard lock(mutex_);
    pending_ = std::move(task);
    if (failure_) {
      std::exchange(pending_, {})();
    }
  }
  news_.notify_one();
  done.get();
}

bool Errands::is_end_of_all(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const Dismissed&) {
    return true;
  } catch (const LostRank&) {
    return true;
  } catch (...) {
    return false;
  }
}

bool Errands::do_one(std::chrono::milliseconds patience) {
  std::packaged_task<void()> errand;
  {
    std::unique_lock lock(mutex_);
    news_.wait_for(lock, patience, [this] { return is_over_ || pending_.valid(); });
    errand = std::exchange(pending_, {});
    if (is_over_) {
      return true;
    }
  }
  if (errand.valid()) {
    errand();
  }
  return false;
}

void Errands::end() {
  const std::lock_guard lock(mutex_);
  is_over_ = true;
  news_.notify_one();
}

void Errands::fail(const std::exception_ptr& failure) {
  std::packaged_task<void()> errand;
  {
    const std::lock_guard lock(mutex_);
    failure_ = failure_ ? failure_ : failure;
    errand = std::exchange(pending_, {});
  }
  if (errand.valid()) {
    errand();
  }
}

}  // namespace dmpc::nodes
