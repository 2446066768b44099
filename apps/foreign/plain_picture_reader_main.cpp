// The program dmpc_plain_picture_reader: decodes PNG, JPEG and EXR for dmpc, which starts it.

#include "apps/foreign/picture_service.h"
#include "apps/foreign/plain_decoder.h"

int main() { dmpc::apps::serve_pictures(dmpc::apps::decode_plain); }
