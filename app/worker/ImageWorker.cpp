// patina-image-worker
#include "app/worker/WorkerMain.h"
#include "core/codec/image/ImageCodec.h"

#include <nlohmann/json.hpp>

using namespace patina;

int main() {
    using Header = nlohmann::json;
    using Request = protocol::Request;
    return worker::workerMain(
        {{"decodeImage",
          [](const Header& header, const Request&, FileDescriptor& payload) {
              return codec::decodeImage(header, payload.get());
          }},
         {"decodeImages",
          [](const Header& header, const Request& request, FileDescriptor& payload) {
              const MemoryFile files = worker::openPayload(request, payload);
              return codec::decodeImages(header, files.bytes());
          }},
         {"encodeImage",
          [](const Header& header, const Request& request, FileDescriptor& payload) {
              const MemoryFile pixels = worker::openPayload(request, payload);
              return codec::encodeImage(header, pixels.bytes());
          }}},
        codec::prepareImageCodec);
}
