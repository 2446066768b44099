#include "apps/system/attempts.h"

#include <ostream>

#include "apps/line/exit_status.h"
#include "apps/system/surroundings.h"
#include "core/base/expect.h"

namespace dmpc::apps {

bool Attempts::make(const std::function<void()>& step) {
  try {
    step();
    return true;
  } catch (const BrokenPipe&) {
    unsaid_ = unsaid_ ? unsaid_ : std::current_exception();
  } catch (const core::InputError& error) {
    messages_ << "dmpc: " << error.what() << std::endl;
  } catch (const std::exception&) {
    unsaid_ = unsaid_ ? unsaid_ : std::current_exception();
  }
  has_failed_ = true;
  return false;
}

int Attempts::status() const {
  if (unsaid_) {
    std::rethrow_exception(unsaid_);
  }
  return has_failed_ ? input_status : 0;
}

}  // namespace dmpc::apps
