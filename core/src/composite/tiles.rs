//! A framebuffer drawn by several threads, each with rows of its own.

use super::{Framebuffer, Pixel};
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};

/// Rows of a tile.
const ROWS: usize = 16;

impl<P: Pixel> Framebuffer<'_, P> {
    /// Calls `draw` for each tile of the picture: a framebuffer of some of its rows, of which only what lies there is
    /// drawn. Each tile gets all triangles in the order of `draw`, so that the number of threads changes nothing.
    ///
    /// # Errors
    ///
    /// Where the progress was told to cancel.
    pub fn draw_tiles(
        &mut self,
        workers: &Workers,
        progress: &Progress,
        draw: impl Fn(&mut Framebuffer<P>) + Sync,
    ) -> Result<(), Cancelled> {
        let Self { size, samples, .. } = *self;
        let (first, row) = (self.rows.start, self.pixels.len() / self.rows.len().max(1));
        let tile = |start: usize, pixels: &mut [P]| {
            let start = first + (start / row) as u32;
            let rows = start..start + (pixels.len() / row) as u32;
            draw(&mut Framebuffer { size, samples, rows, pixels });
        };
        workers.update(self.pixels, (row * ROWS).max(1), progress, tile)?;
        Ok(())
    }
}
