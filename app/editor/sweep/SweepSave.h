// What a sweep found, as files: the ranking as JSON, or the rotations of an environment as one
// picture.
#pragma once

#include "app/editor/sweep/SweepWork.h"

#include <QImage>
#include <QString>
#include <cstddef>
#include <string>

class QWidget;

namespace patina::editor {

class DocumentController;
class JobManager;

// As `patina rank -o` writes it. `scene`: where the scene is stored; empty: nowhere.
[[nodiscard]] std::string rankingFile(const SweepOutcome& outcome, RankBy by,
                                      const std::string& scene);

// An environment in all its rotations, row by row, with its name above them and below each its
// rotation and score. Null after a cancel; on any thread.
[[nodiscard]] QImage rotationSheet(const SweepOutcome& outcome, std::size_t environment, RankBy by,
                                   const JobContext& job);

struct SweepSave {
    SweepOutcomePtr outcome;
    RankBy by = RankBy::Difference;
    std::size_t environment = 0; // whose rotations a picture shows
    QString file;                // .json or .png
};
// A job; notices say where the file is, or why there is none.
void saveSweep(const SweepSave& save, DocumentController& controller, JobManager& jobs);

// Asks for the file, and saves to it.
void askAndSaveSweep(SweepSave save, DocumentController& controller, JobManager& jobs,
                     QWidget& parent);

} // namespace patina::editor
