// What extensions a glTF document uses, and what that means for its picture.
#pragma once

#include <string>
#include <vector>

#include "apps/foreign/gltf/document.h"

namespace dmpc::apps::gltf {

/// Throws core::InputError that names all extensions that the document requires and that are not shown here.
void check_required(const Document& document);

/// Appends a sentence, with a count, for each kind of thing that is there by an extension, or by glTF itself, and not shown as it
/// is (apps/foreign/gltf/places.h says what else is not), and one that names all extensions that are
/// not known.
void note_extensions(const Document& document, std::vector<std::string>& notes);

}  // namespace dmpc::apps::gltf
