// Questions to the program, and its answers, which come in the order of the questions.

export class Connection {
  constructor(onChange) {
    this.onChange = onChange;
    this.waiting = [];
    this.open();
  }

  open() {
    const url = new URL("socket", location.href);
    url.protocol = "ws:";
    this.socket = new WebSocket(url);
    this.socket.binaryType = "arraybuffer";
    this.socket.onopen = () => this.onChange(true);
    this.socket.onmessage = ({ data }) => this.waiting.shift()?.resolve(data);
    this.socket.onclose = () => {
      for (const { reject } of this.waiting.splice(0)) reject(new Error("the connection was closed"));
      this.onChange(false);
      setTimeout(() => this.open(), 1000);
    };
  }

  ask(question) {
    if (this.socket.readyState !== WebSocket.OPEN) return Promise.reject(new Error("there is no connection"));
    return new Promise((resolve, reject) => {
      this.waiting.push({ resolve, reject });
      this.socket.send(JSON.stringify(question));
    });
  }

  /** An answer that is JSON; throws what the program has against the question. */
  async askJson(question) {
    const answer = JSON.parse(await this.ask(question));
    if (answer?.error) throw new Error(answer.error);
    return answer;
  }

  /** A layer of a picture as half floats, or null if there is none newer than `have`. */
  async askPicture(of, layer, have) {
    const data = await this.ask({ ask: "picture", of, layer, have });
    if (typeof data === "string") return null;
    const length = new DataView(data).getUint32(0, true);
    const header = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)));
    return { ...header, halves: new Uint16Array(data, 4 + length) };
  }
}
