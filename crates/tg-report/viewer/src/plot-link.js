/** Joins the plots over time with the clock and with each other's zoom. */
export class PlotLink {
  constructor(clock) {
    this.clock = clock;
    this.cards = [];
  }

  add(card) {
    this.cards.push(card);
    this.clock?.listen(() => card.showTime(this.clock.time));
  }

  seek(time) {
    if (!this.clock) return;
    this.clock.playing = false;
    this.clock.seek(time);
  }

  zoom(range) {
    for (const card of this.cards) card.zoom(range);
  }
}
