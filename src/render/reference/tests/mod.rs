//! What users of the reference rely on.
