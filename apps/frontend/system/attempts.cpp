#include "apps/frontend/system/attempts.h"

#include <ostream>

#include "apps/frontend/line/exit_status.h"
#include "apps/frontend/system/surroundings.h"
#include "core/base/expect.h"

namespace dmpc::apps {

bool Attempts::make(const std::function<void()>& step) {
  try {
    step();
    return true;
  } catch (const BrokenPipe&) {
    unsaid_ = unsaid_ ? unsaid_ : std::current_exception();
  } catch (const core::CapacityError& error) {
    say(error, no_capacity_status);
  } catch (const core::InputError& error) {
    say(error, input_status);
  } catch (const std::exception&) {
    unsaid_ = unsaid_ ? unsaid_ : std::current_exception();
  }
  return false;
}

void Attempts::say(const std::exception& error, int status) {
  messages_ << name_ << ": " << error.what() << std::endl;
  status_ = status_ == 0 ? status : status_;
}

int Attempts::status() const {
  if (unsaid_) {
    std::rethrow_exception(unsaid_);
  }
  return status_;
}

}  // namespace dmpc::apps
