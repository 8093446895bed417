#include "core/codec/model/ObjReader.h"

#include "core/codec/model/AssimpReader.h"
#include "core/codec/model/ObjText.h"

namespace patina::codec {

ImportedModel readObj(const ModelFolder& folder) {
    std::optional<ObjText> text;
    if (const auto file = folder.open(folder.modelPath().string()))
        text = readObjText(file->text());
    if (!text || text->runs.empty()) // Assimp knows what to say of a file without faces
        return readWithAssimp(folder, "obj");
    return readObjParts(folder, *text);
}

} // namespace patina::codec
