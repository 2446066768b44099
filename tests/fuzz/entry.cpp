// One target as libFuzzer calls it.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>

#include "tests/fuzz/targets.h"

extern "C" int LLVMFuzzerInitialize(int* /*count*/, char*** /*words*/) {
  dmpc::fuzz::covered();  // made before, so that it is there in the end
  return std::atexit([] { dmpc::fuzz::covered().print(std::cerr); });
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  dmpc::fuzz::DMPC_FUZZ_TARGET(data, size);
  return 0;
}
