// When the page is drawn: with the screen's next picture. At full speed, where nobody can follow,
// twice a second, because drawing takes the processors that the bench wants.
const unhurried_ms = 500;

export class DrawPace {
  private waiting: number | null = null;
  private asked = false;

  constructor(private readonly draw: () => void) {}

  ask(atFullSpeed: boolean): void {
    if (this.asked) return;
    if (atFullSpeed) {
      this.waiting ??= window.setTimeout(() => this.drawNext(), unhurried_ms);
    } else {
      this.drawNext();
    }
  }

  private drawNext(): void {
    if (this.waiting !== null) window.clearTimeout(this.waiting);
    this.waiting = null;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      this.draw();
    });
  }
}
