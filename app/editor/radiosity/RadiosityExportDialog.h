// Writes the radiosity that the dock shows for other programs: as COLLADA, glTF or PLY, at the
// vertices or in a light map.
#pragma once

#include <QDialog>
#include <filesystem>
#include <string>

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;

namespace patina {
struct Document;
struct ExposureRequest;
} // namespace patina

namespace patina::editor {

class DocumentController;
class JobManager;
class OutputFile;
class RadiosityUpdater;

// The COLLADA document that all meshes of the scene were read from; an empty path: there is none.
struct ColladaOrigin {
    std::filesystem::path file;
    std::string visualScene; // of it; empty: the one that it names
};
[[nodiscard]] ColladaOrigin colladaOrigin(const Document& document);

class RadiosityExportDialog : public QDialog {
    Q_OBJECT
  public:
    // There is a solution: radiosity.live().
    RadiosityExportDialog(DocumentController& controller, RadiosityUpdater& radiosity,
                          JobManager& jobs, QWidget* parent = nullptr);

  private:
    QWidget* makeSettings();
    void refresh();
    void run();
    [[nodiscard]] bool isLightMap() const;
    [[nodiscard]] ExposureRequest exposure() const;

    DocumentController& m_controller;
    RadiosityUpdater& m_radiosity;
    JobManager& m_jobs;
    const ColladaOrigin m_origin;

    OutputFile* m_output;
    QCheckBox* m_intoOrigin = nullptr;
    QComboBox *m_light = nullptr, *m_size = nullptr, *m_exposure = nullptr;
    QDoubleSpinBox* m_k = nullptr;
    QLabel* m_summary = nullptr;
};

} // namespace patina::editor
