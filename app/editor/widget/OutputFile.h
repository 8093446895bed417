// What a dialog that writes a file asks: the format and the path, whose extension follow each
// other; and the buttons that end it.
#pragma once

#include <QObject>
#include <vector>

class QComboBox;
class QDialog;
class QFormLayout;
class QLayout;
class QLineEdit;
class QPushButton;

namespace patina::editor {

class OutputFile : public QObject {
    Q_OBJECT
  public:
    struct Format {
        QString title;     // "OpenEXR (32-bit float)"
        QString extension; // "exr"
        QString filter;    // of file dialogs: "OpenEXR"
    };
    // `name` begins the names of its widgets: nameFormat, namePath, nameRun. `suggestion`: the path
    // shown first, which has the first format's extension.
    OutputFile(const QString& name, const std::vector<Format>& formats, const QString& suggestion,
               QDialog& dialog);

    void addFormatRow(QFormLayout& form, const QString& help);
    void addFileRow(QFormLayout& form);
    // It can be seen, and not be chosen, for `reason`.
    void disableFormat(int index, const QString& reason);
    void addButtons(QLayout& layout, const QString& run);

    [[nodiscard]] int format() const; // index
    [[nodiscard]] QString path() const;
    // Whether it can be written, and what the button says then.
    void setRunnable(bool runnable, const QString& run);

  Q_SIGNALS:
    void changed(); // path or format
    void accepted();

  private:
    void browse();
    void followFormat();
    void followPath();

    QDialog& m_dialog;
    QString m_name;
    std::vector<Format> m_formats;
    QComboBox* m_format;
    QLineEdit* m_path;
    QPushButton* m_run = nullptr;
};

} // namespace patina::editor
