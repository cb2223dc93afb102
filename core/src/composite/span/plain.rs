//! With the instructions that every processor of the target has.

pub(super) use super::each as lay;
