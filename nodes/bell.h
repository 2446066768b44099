// How a receiver is told of a packet that does not wake a thread.
#pragma once

namespace dmpc::nodes {

/// Of a receiver that shares its thread with others, which is to be told that this one is no longer asleep.
class Bell {
 public:
  /// Never blocks. Called by the thread that has replaced ASLEEP, which is counted itself.
  virtual void ring() = 0;

 protected:
  ~Bell() = default;
};

}  // namespace dmpc::nodes
