// What to bake and how finely: a row for each setting that applies
// (core/bake/domain/BakeOptions.h), kept for each kind of bake.
#pragma once

#include "core/bake/domain/BakeOptions.h"

#include <QWidget>
#include <map>
#include <set>
#include <vector>

class QComboBox;
class QFormLayout;

namespace patina::editor {

class BakeSettingsForm : public QWidget {
    Q_OBJECT
  public:
    explicit BakeSettingsForm(QWidget* parent = nullptr);

    [[nodiscard]] BakeRequest request() const { return requestFor(kind()); }
    // What the form would ask for if it showed that kind.
    [[nodiscard]] BakeRequest requestFor(BakeKind kind) const;
    // What the request says of its kind. What it does not say, because it does not shape the
    // result, stays as it is.
    void setRequest(const BakeRequest& request);
    // The same, unless the user has changed something since.
    void follow(const BakeRequest& request);
    void showKind(BakeKind kind);

  Q_SIGNALS:
    void changed();

  private:
    // Shows and reads one setting.
    struct Row {
        const BakeOption* option;
        QWidget* field;
        void (*show)(QWidget* field, const BakeOption& option, double value);
    };
    [[nodiscard]] BakeKind kind() const;
    Row makeRow(const BakeOption& option);
    void edit(const BakeOption& option, double value);
    void refresh();

    QFormLayout* m_form;
    QComboBox* m_kind;
    std::vector<Row> m_rows;
    std::map<BakeKind, BakeRequest> m_requests;
    std::set<BakeKind> m_edited; // since setRequest()
    bool m_refreshing = false;
};

} // namespace patina::editor
