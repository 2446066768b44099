// What fuzzers try, a function a target: any bytes, which are refused or as promised (tests/README.md has the promises). A fuzzer
// is a program that calls one of them (entry.cpp); the suite calls all with the inputs of their corpora (corpora_test.cpp). What
// is not as promised ends the process, or throws core::expect's word of it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tests/support/coverage.h"

namespace dmpc::fuzz {

/// What the inputs so far have come to.
inline tests::Coverage& covered() {
  static tests::Coverage all("fuzz");
  return all;
}

void try_checkpoint(const std::uint8_t* data, std::size_t size);
void try_gltf(const std::uint8_t* data, std::size_t size);
void try_machine(const std::uint8_t* data, std::size_t size);
void try_mesh(const std::uint8_t* data, std::size_t size);
void try_mesh_text(const std::uint8_t* data, std::size_t size);
void try_nff(const std::uint8_t* data, std::size_t size);
void try_pbrt(const std::uint8_t* data, std::size_t size);
void try_picture(const std::uint8_t* data, std::size_t size);
void try_polygon(const std::uint8_t* data, std::size_t size);
void try_reply(const std::uint8_t* data, std::size_t size);

}  // namespace dmpc::fuzz
