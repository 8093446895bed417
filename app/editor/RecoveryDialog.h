// Offers unsaved work of editors that ended: what it is, with its picture, and what differs from
// the saved file.
#pragma once

#include "core/recovery/RecoverySession.h"

#include <QDialog>
#include <vector>

class QLabel;
class QListWidget;
class QPushButton;
class QTableWidget;

namespace patina::editor {

class RecoveryDialog : public QDialog {
    Q_OBJECT
  public:
    // At least one; those that are not taken stay on the disk, and are given back with the dialog.
    explicit RecoveryDialog(std::vector<AbandonedWork> works, QWidget* parent = nullptr);
    ~RecoveryDialog() override;

    [[nodiscard]] AbandonedWork takeCurrent(); // only in answer to recoverRequested()

  Q_SIGNALS:
    void recoverRequested(); // the current one

  private:
    QWidget* makeDetails();
    QWidget* makeComparison();
    void showCurrent();
    void showPictures();
    void compare(bool shown);
    void fillDifferences();
    void discard();
    void remove(std::size_t index);
    [[nodiscard]] std::size_t current() const;
    [[nodiscard]] const AbandonedWork& work() const { return m_works[current()]; }

    std::vector<AbandonedWork> m_works; // as the rows of m_list
    QListWidget* m_list;
    QLabel *m_title, *m_facts, *m_leftOut;
    QLabel *m_picture, *m_savedPicture, *m_pictureName, *m_savedPictureName;
    QLabel* m_summary;
    QTableWidget* m_table;
    QPushButton *m_compare, *m_recover, *m_discard;
};

} // namespace patina::editor
