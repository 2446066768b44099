#include "apps/foreign/import.h"

#include <assimp/BaseImporter.h>
#include <doctest/doctest.h>

#include <assimp/Importer.hpp>
#include <set>
#include <string>

#include "apps/formats/mesh_file.h"

namespace dmpc::apps::import_test {

TEST_CASE("of Assimp's readers those of a file's ending stay, and no others") {
  for (const std::string& ending : mesh_extensions()) {
    CAPTURE(ending);
    if (has_own_sky("a." + ending)) {  // which no reader of Assimp's reads
      continue;
    }
    Assimp::Importer importer;
    keep_readers_of(ending, importer);
    CHECK(importer.GetImporterCount() >= 1);
    CHECK(importer.GetImporterCount() <= 2);
    for (std::size_t i = 0; i < importer.GetImporterCount(); ++i) {
      std::set<std::string> endings;
      importer.GetImporter(i)->GetExtensionList(endings);
      CHECK(endings.contains(ending));
    }
  }
}

}  // namespace dmpc::apps::import_test
