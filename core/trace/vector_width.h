// How wide this processor's vectors are.
#pragma once

#include <cstdint>

namespace dmpc::core {

/// What a loop is compiled for: any processor, or one with all of x86-64-v3 (AVX2) or of v4 (AVX-512). All give the same bits.
enum class VectorWidth : std::uint8_t { any, bits_256, bits_512 };

/// The widest that this processor has.
VectorWidth vector_width();

}  // namespace dmpc::core
