/* What libraries let others see. C reads this, too. */
#ifndef WEND_CORE_EXPORT_H
#define WEND_CORE_EXPORT_H

/** Names that are promised: they are visible from outside a shared library; all others are hidden. */
#define WEND_API __attribute__((visibility("default")))

#endif
