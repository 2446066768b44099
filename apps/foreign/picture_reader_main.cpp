// The program dmpc_picture_reader: decodes pictures for dmpc, which starts it, by OpenImageIO.

#include "apps/foreign/picture_decoder.h"
#include "apps/foreign/picture_service.h"

int main() {
  dmpc::apps::prepare_decoders();
  dmpc::apps::serve_pictures(dmpc::apps::decode);
}
