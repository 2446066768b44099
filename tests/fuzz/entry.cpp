// One target as libFuzzer calls it.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  dmpc::fuzz::DMPC_FUZZ_TARGET(data, size);
  return 0;
}
