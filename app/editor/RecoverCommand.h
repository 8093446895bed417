// Unsaved work as one undo step on top of what was saved: the document is modified by nothing else,
// and undo shows the saved state.
#pragma once

#include "app/editor/document/Commands.h"

namespace patina::editor {

class RecoverCommand : public DocumentCommand {
  public:
    // Payloads that `after` and the present document both name are shared.
    RecoverCommand(DocumentController& controller, Document after);

  protected:
    Change swap(Document& document, bool forward) override;

  private:
    Document m_before, m_after;
};

} // namespace patina::editor
