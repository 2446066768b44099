#include "nodes/ranks/errands.h"

#include <utility>

#include "nodes/ranks/dismissal.h"
#include "nodes/ranks/fabric.h"

namespace dmpc::nodes {

namespace {

/// What it throws, or nothing.
std::exception_ptr failure_in(const std::function<void()>& act) {
  try {
    act();
    return nullptr;
  } catch (...) {
    return std::current_exception();
  }
}

}  // namespace

void Errands::send(const std::function<void()>& act) {
  Errand errand{.act = &act};
  {
    std::unique_lock lock(mutex_);
    if (failure_) {
      end(errand, failure_);
    } else {
      pending_ = &errand;
      news_.notify_all();
      news_.wait(lock, [&errand] { return errand.is_done; });
    }
  }
  if (errand.failure) {
    std::rethrow_exception(errand.failure);
  }
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
  std::unique_lock lock(mutex_);
  news_.wait_for(lock, patience, [this] { return is_over_ || pending_ != nullptr; });
  if (pending_ == nullptr) {
    return is_over_;
  }
  Errand& errand = *std::exchange(pending_, nullptr);
  lock.unlock();
  std::exception_ptr failure = failure_in(*errand.act);
  lock.lock();
  end(errand, std::move(failure));
  return false;
}

void Errands::end(Errand& errand, std::exception_ptr failure) {
  errand.failure = std::move(failure);
  errand.is_done = true;
  news_.notify_all();
}

void Errands::end_work() {
  const std::lock_guard lock(mutex_);
  is_over_ = true;
  news_.notify_all();
}

void Errands::fail(const std::exception_ptr& failure) {
  const std::lock_guard lock(mutex_);
  failure_ = failure_ ? failure_ : failure;
  if (pending_ != nullptr) {
    end(*std::exchange(pending_, nullptr), failure_);
  }
}

}  // namespace dmpc::nodes
