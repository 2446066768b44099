// How wide this processor's vectors are, and loops compiled for each width.
#pragma once

#include <cstdint>

namespace dmpc::core {

/// What a loop is compiled for: any processor, or one with all of x86-64-v3 (AVX2) or of v4 (AVX-512). All give the same bits.
enum class VectorWidth : std::uint8_t { any, bits_256, bits_512 };

/// The widest that this processor has.
VectorWidth vector_width();

template <class Loop>
[[gnu::target("arch=x86-64-v4"), gnu::flatten]] void run_by_512(const Loop& loop) {
  loop();
}
template <class Loop>
[[gnu::target("arch=x86-64-v3"), gnu::flatten]] void run_by_256(const Loop& loop) {
  loop();
}
/// Calls loop(), which is compiled for each width; its body is one straight line, as compilers vectorise it. Requires a processor
/// that has the width.
template <class Loop>
void run_by(VectorWidth width, const Loop& loop) {
  switch (width) {
    case VectorWidth::bits_512:
      return run_by_512(loop);
    case VectorWidth::bits_256:
      return run_by_256(loop);
    case VectorWidth::any:
      return loop();
  }
}

}  // namespace dmpc::core
