// The snapshots of a project's text: of each look only what differs from the document beside it, so
// that one that is damaged takes none of the others with it. Lists of ids stand there where the
// look has other elements; those that the document does not have are written in full.
#pragma once

#include "core/document/Document.h"
#include "core/scene/ProjectValues.h"
#include "core/scene/ProjectWriting.h"

#include <string>
#include <vector>

namespace patina {

class SceneLoader;

namespace project {

[[nodiscard]] Json snapshotsToJson(const Writing& writing);

// Into the document, which is read otherwise. What cannot be read is left out, with a message.
void readSnapshots(const Node& list, Document& document, Reading& reading,
                   std::vector<std::string>& leftOut);

// Gives the looks the images that they name, those of the document where it has them.
void loadSnapshotImages(SceneLoader& loader, Document& document);

} // namespace project
} // namespace patina
